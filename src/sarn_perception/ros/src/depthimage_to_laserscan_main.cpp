// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "sarn_perception_ros/depth_to_scan_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "depthimage_to_laserscan");
  try {
    const sarn_perception::DepthToScanNode node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
