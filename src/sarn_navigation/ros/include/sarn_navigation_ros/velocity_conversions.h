// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <sensor_msgs/LaserScan.h>

#include <optional>

#include "sarn_navigation/obstacle_memory.h"

namespace sarn_navigation {

/// True when all six numbers are finite.
[[nodiscard]] bool isFinite(const geometry_msgs::Twist& twist);

/// Nothing when the scan has no ranges, or when its angles or range limits cannot be used.
[[nodiscard]] std::optional<Scan> fromMessage(const sensor_msgs::LaserScan& message);

}  // namespace sarn_navigation
