// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "sarn_common_ros/parameter_reader.h"
#include "sarn_localization_ros/slam_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "slam");
  // Outside the try block: the death of the last NodeHandle shuts logging down, before the FATAL line is out.
  ros::NodeHandle nh;
  try {
    const auto params = sarn::readParameters<sarn_localization::SlamParams>(ros::NodeHandle("~"));
    const sarn_localization::SlamNode slam(nh, params);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
