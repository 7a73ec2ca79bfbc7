// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <people_msgs/People.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <set>
#include <vector>

#include "sim_world.h"
#include "wait_for.h"

namespace sarn_perception {
namespace {

class PredictionNodeTest : public ::testing::Test {
 protected:
  PredictionNodeTest() {
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    tf_ = nh_.advertise<tf2_msgs::TFMessage>("/tf", 10);
    people_ = nh_.advertise<people_msgs::People>("people", 10);
    map_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    predictions_ = nh_.subscribe<sarn_msgs::PeoplePrediction>(
        "people_prediction", 100,
        [this](const sarn_msgs::PeoplePredictionConstPtr& prediction) { last_ = *prediction; });
    markers_ = nh_.subscribe<visualization_msgs::MarkerArray>(
        "prediction_viz", 100,
        [this](const visualization_msgs::MarkerArrayConstPtr& markers) { drawn_ = *markers; });
    map_.publish(mapWithWall());
  }

  bool connected() {
    return waitFor([this] {
      return predictions_.getNumPublishers() == 1 && markers_.getNumPublishers() == 1 &&
             people_.getNumSubscribers() == 1 && tf_.getNumSubscribers() == 1 &&
             map_.getNumSubscribers() == 1;
    });
  }

  void tick() {
    time_ += 0.05;
    clock_.publish(clockAt(time_));
    tf2_msgs::TFMessage tf;
    tf.transforms.push_back(transformAt(time_, "map", "odom", 1.0, 2.0, 0.5 * 3.14159265358979));
    tf_.publish(tf);
  }

  void send(const std::string& frame, const std::vector<people_msgs::Person>& people) {
    people_msgs::People message;
    message.header.frame_id = frame;
    message.header.stamp = ros::Time(time_);
    message.people = people;
    people_.publish(message);
  }

  /// Ticks, sending `people` all the time, until the last prediction satisfies the condition.
  bool predicted(const std::string& frame, const std::vector<people_msgs::Person>& people,
                 const std::function<bool()>& condition) {
    return waitFor(condition, 60.0, [&] {
      tick();
      if (!frame.empty()) send(frame, people);
    });
  }

  ros::NodeHandle nh_;
  ros::Publisher clock_, tf_, people_, map_;
  ros::Subscriber predictions_, markers_;
  double time_ = 100.0;  // [s]
  sarn_msgs::PeoplePrediction last_;
  visualization_msgs::MarkerArray drawn_;
};

TEST_F(PredictionNodeTest, predictsForgetsAndSurvivesAClockThatJumpsBack) {
  ASSERT_TRUE(connected());
  ASSERT_TRUE(predicted("map", {personAt("anna", 1.0, 2.0, 0.5, 0.0), personAt("bert", 2.0, 8.0)},
                        [this] { return last_.people.size() == 2 && drawn_.markers.size() == 2; }));
  EXPECT_EQ(last_.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(last_.time_step.toSec(), 0.5);
  const auto& anna = last_.people[0];
  EXPECT_EQ(anna.name, "anna");
  EXPECT_EQ(anna.group, "friends");
  ASSERT_EQ(anna.states.size(), 20U);
  EXPECT_NEAR(anna.states[4].x - anna.states[0].x, 1.0, 1e-6);
  EXPECT_GT(anna.states[19].sigma, anna.states[0].sigma);
  EXPECT_LT(anna.states[19].x, 5.0) << "the wall begins at 5 m";
  std::set<int> ids;
  for (const auto& marker : drawn_.markers) ids.insert(marker.id);
  EXPECT_EQ(ids.size(), 2U) << "a marker a person";

  // Nobody measured any more: an empty prediction, and the markers are deleted.
  ASSERT_TRUE(
      predicted("", {}, [this] { return last_.people.empty() && last_.header.stamp.toSec() > 100.0; }));

  // In another frame, turned by a quarter.
  ASSERT_TRUE(
      predicted("odom", {personAt("cora", 1.0, 0.0, 0.4, 0.0)}, [this] { return last_.people.size() == 1; }));
  EXPECT_NEAR(last_.people[0].states[0].x, 1.0, 1e-6);
  EXPECT_NEAR(last_.people[0].states[0].y, 3.0, 0.4 * 0.5);
  EXPECT_NEAR(last_.people[0].states[0].vx, 0.0, 1e-6);
  EXPECT_NEAR(last_.people[0].states[0].vy, 0.4, 1e-6);

  // In a frame that tf does not know: left out, while predictions go on.
  ASSERT_TRUE(predicted("moon", {personAt("dora", 1.0, 0.0)}, [this] { return last_.people.empty(); }));

  // NaN is left out, a name given twice is taken once.
  ASSERT_TRUE(predicted(
      "map", {personAt("emma", std::nan(""), 0.0), personAt("fred", 1.0, 1.0), personAt("fred", 2.0, 1.0)},
      [this] { return last_.people.size() == 1; }));
  EXPECT_EQ(last_.people[0].name, "fred");
  EXPECT_DOUBLE_EQ(last_.people[0].states[0].x, 1.0);

  // The clock jumps back: everybody is forgotten at once, and predictions go on.
  time_ = 10.0;
  ASSERT_TRUE(predicted("", {}, [this] { return last_.header.stamp.toSec() < 90.0; }));
  EXPECT_TRUE(last_.people.empty());
  ASSERT_TRUE(predicted("map", {personAt("gina", 1.0, 1.0)}, [this] { return last_.people.size() == 1; }));
  EXPECT_EQ(last_.people[0].name, "gina");
}

}  // namespace
}  // namespace sarn_perception

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "constant_velocity_prediction_rostest");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
