// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "sarn_common_ros/send_at_once.h"

namespace sarn {

/// main() of a node: calls `run(nh, private_nh)`, which returns at the shutdown.
/// Whatever it throws becomes one FATAL line and exit code 1.
template <class Run>
int runNode(int argc, char** argv, const char* name, Run run) {
  ros::init(argc, argv, name);
  // Outside the try block: the death of the last NodeHandle shuts logging down, before the FATAL line is out.
  ros::NodeHandle nh;
  ros::NodeHandle private_nh("~");
  try {
    sendAtOnce();
    run(nh, private_nh);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

/// The same for a class constructed from (nh, private_nh) that works in callbacks.
template <class Node>
int runNode(int argc, char** argv, const char* name) {
  return runNode(argc, argv, name, [](const ros::NodeHandle& nh, const ros::NodeHandle& private_nh) {
    const Node node(nh, private_nh);
    ros::spin();
  });
}

}  // namespace sarn
