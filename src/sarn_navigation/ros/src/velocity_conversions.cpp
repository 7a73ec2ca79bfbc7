// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/velocity_conversions.h"

#include <cmath>

namespace sarn_navigation {

bool isFinite(const geometry_msgs::Twist& twist) {
  return std::isfinite(twist.linear.x) && std::isfinite(twist.linear.y) && std::isfinite(twist.linear.z) &&
         std::isfinite(twist.angular.x) && std::isfinite(twist.angular.y) && std::isfinite(twist.angular.z);
}

std::optional<Scan> fromMessage(const sensor_msgs::LaserScan& message) {
  const bool usable = !message.ranges.empty() && std::isfinite(message.angle_min) &&
                      std::isfinite(message.angle_increment) && message.angle_increment != 0.0F &&
                      std::isfinite(message.range_min) && std::isfinite(message.range_max) &&
                      message.range_min >= 0.0F && message.range_max > message.range_min;
  if (!usable) return std::nullopt;
  return Scan{message.angle_min,
              message.angle_increment,
              message.range_min,
              message.range_max,
              {message.ranges.begin(), message.ranges.end()}};
}

}  // namespace sarn_navigation
