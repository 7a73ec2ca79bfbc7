// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <people_msgs/People.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <vector>

#include "sim_world.h"
#include "wait_for.h"

namespace sarn_perception {
namespace {

/// Plays the simulator: a robot at (2, 2), people around it, a wall.
class FakeDetectionNodeTest : public ::testing::Test {
 protected:
  FakeDetectionNodeTest() {
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    tf_ = nh_.advertise<tf2_msgs::TFMessage>("/tf", 10);
    truth_ = nh_.advertise<people_msgs::People>("ground_truth/people", 10);
    map_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    people_ =
        nh_.subscribe<people_msgs::People>("people", 100, [this](const people_msgs::PeopleConstPtr& people) {
          received_.push_back(*people);
          ages_.push_back(time_ - people->header.stamp.toSec());
        });
    map_.publish(mapWithWall());
  }

  /// One step of 0.05 s of the world.
  void step() {
    time_ += 0.05;
    clock_.publish(clockAt(time_));
    tf2_msgs::TFMessage tf;
    tf.transforms.push_back(transformAt(time_, "map", "base_footprint", 2.0, 2.0));
    tf_.publish(tf);
    people_msgs::People truth;
    truth.header.frame_id = "map";
    truth.header.stamp = ros::Time(time_);
    truth.people = {personAt("anna", 3.0, 3.0, 0.5, 0.0), personAt("behind_wall", 7.0, 2.0),
                    personAt("far", 2.0, 11.0)};
    truth_.publish(truth);
  }

  ros::NodeHandle nh_;
  ros::Publisher clock_, tf_, truth_, map_;
  ros::Subscriber people_;
  double time_ = 100.0;  // [s]
  std::vector<people_msgs::People> received_;
  std::vector<double> ages_;  // [s] of the messages when they came, at least
};

TEST_F(FakeDetectionNodeTest, reportsWhoIsInSightLateAndAtItsRate) {
  ASSERT_TRUE(waitFor([this] {
    return people_.getNumPublishers() == 1 && truth_.getNumSubscribers() == 1 &&
           tf_.getNumSubscribers() == 1 && map_.getNumSubscribers() == 1;
  }));
  ASSERT_TRUE(waitFor([this] { return received_.size() >= 20; }, 60.0, [this] { step(); }));
  const people_msgs::People& people = received_.back();
  EXPECT_EQ(people.header.frame_id, "map");
  ASSERT_EQ(people.people.size(), 1U) << "one is behind the wall, one is too far";
  EXPECT_EQ(people.people[0].name, "anna");
  EXPECT_DOUBLE_EQ(people.people[0].position.x, 3.0);
  EXPECT_DOUBLE_EQ(people.people[0].velocity.x, 0.5);
  ASSERT_EQ(people.people[0].tagnames, std::vector<std::string>{"group"});
  EXPECT_EQ(people.people[0].tags, std::vector<std::string>{"friends"});
  for (const double age : ages_) EXPECT_GE(age, 0.2 - 1e-6) << "published a latency after the measurement";
  for (std::size_t i = 1; i < received_.size(); ++i) {
    const double period = (received_[i].header.stamp - received_[i - 1].header.stamp).toSec();
    EXPECT_GE(period, 0.1 - 1e-6) << "the truth comes at 20 Hz, the detector looks at 10 Hz";
  }
  // The clock jumps back: the node goes on from there.
  time_ = 10.0;
  received_.clear();
  ages_.clear();
  ASSERT_TRUE(waitFor([this] { return received_.size() >= 3; }, 60.0, [this] { step(); }));
  EXPECT_LT(received_.back().header.stamp.toSec(), 90.0);
}

}  // namespace
}  // namespace sarn_perception

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "fake_detection_rostest");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
