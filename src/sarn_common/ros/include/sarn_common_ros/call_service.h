// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <string>

namespace sarn {

/// Calls a ROS service; whether it answered. Instead of ros::service::call: there the server hangs up right
/// after its answer, and roscpp now and then sees the hang-up first and throws the answer away. Here the
/// client hangs up, after it has read.
template <class Service>
[[nodiscard]] bool callService(const std::string& name, Service& service) {
  constexpr bool kPersistent = true;
  return ros::NodeHandle().serviceClient<Service>(ros::names::resolve(name), kPersistent).call(service);
}

}  // namespace sarn
