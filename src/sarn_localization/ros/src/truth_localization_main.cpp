// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "sarn_common_ros/parameter_reader.h"
#include "sarn_localization_ros/truth_localization.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "truth_localization");
  // Outside the try block: the death of the last NodeHandle shuts logging down, before the FATAL line is out.
  ros::NodeHandle nh;
  try {
    auto params = sarn::readParameters<sarn_localization::TruthLocalizationParams>(ros::NodeHandle("~"));
    const sarn_localization::TruthLocalization localization(nh, params);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
