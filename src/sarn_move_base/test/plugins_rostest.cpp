// SPDX-License-Identifier: BSD-3-Clause
// The tests of all plug-ins in one node: messages travel over real topics.
#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "move_base_plugins");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
