// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>

namespace sarn_perception {

/// Handles callbacks until the condition holds; false after `timeout` [s] of wall time.
inline bool waitFor(const std::function<bool()>& condition, double timeout = 30.0,
                    const std::function<void()>& meanwhile = {}) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout);
  while (ros::ok() && !condition()) {
    if (ros::WallTime::now() > end) return false;
    if (meanwhile) meanwhile();
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
  }
  return ros::ok();
}

}  // namespace sarn_perception
