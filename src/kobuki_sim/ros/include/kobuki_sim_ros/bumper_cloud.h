// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>

namespace kobuki_sim {

/// Bumpers and cliff sensors as obstacle points in base_link (what kobuki_bumper2pc publishes for a costmap):
/// left, centre, right on a circle of 0.24 m, the sides 20 deg ahead of the lateral axis, 0.04 m high. A
/// point that is not active lies 100 m away.
[[nodiscard]] sensor_msgs::PointCloud2 bumperCloud(std::uint8_t bumper, std::uint8_t cliff,
                                                   const ros::Time& stamp);

}  // namespace kobuki_sim
