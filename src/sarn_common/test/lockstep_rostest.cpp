// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Time.h>

#include <functional>
#include <vector>

#include "sarn_common_ros/lockstep_acknowledger.h"

namespace {

class Lockstep : public testing::Test {
 protected:
  Lockstep() {
    ros::Time::setNow(ros::Time(50.0));
    subscriber_ = nh_.subscribe<std_msgs::Time>(
        "lockstep/tested", 100,
        [this](const std_msgs::TimeConstPtr& m) { heard_.push_back(m->data.toSec()); });
  }
  bool await(const std::function<bool()>& condition) {
    while (ros::ok() && !condition()) {
      ros::spinOnce();
      ros::WallDuration(0.002).sleep();
    }
    return ros::ok();
  }

  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
  std::vector<double> heard_;
};

TEST_F(Lockstep, saysHowFarTheNodeHasCome) {
  sarn::LockstepAcknowledger acknowledger(nh_, "lockstep/tested");
  ASSERT_TRUE(await([&] { return subscriber_.getNumPublishers() > 0; }));
  ASSERT_TRUE(await([&] {  // until the connection stands
    acknowledger.acknowledge(ros::Time(49.5));
    return !heard_.empty() && heard_.back() == 49.5;
  }));
  acknowledger.acknowledge(ros::Time(49.75));
  EXPECT_TRUE(await([&] { return heard_.back() == 49.75; }));
}

TEST_F(Lockstep, idleNodeHasComeAsFarAsTheClock) {
  const sarn::LockstepAcknowledger acknowledger(nh_, "lockstep/tested");
  EXPECT_TRUE(await([&] { return !heard_.empty() && heard_.back() == 50.0; }))
      << "nothing was ever processed";
  ros::Time::setNow(ros::Time(51.0));
  EXPECT_TRUE(await([&] { return heard_.back() == 51.0; }));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "lockstep");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
