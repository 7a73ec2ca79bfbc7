// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <exception>

namespace sarn_navigation {

/// Runs a node until it is shut down; whatever its constructor throws becomes one FATAL line and exit code 1.
template <class Node>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  // Outside the try block: the death of the last NodeHandle shuts logging down, before the FATAL line could
  // be written.
  ros::NodeHandle nh;
  ros::NodeHandle private_nh("~");
  try {
    Node node(nh, private_nh);
    ros::spin();
  } catch (const std::exception& e) {
    ROS_FATAL("%s", e.what());
    return 1;
  }
  return 0;
}

}  // namespace sarn_navigation
