// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>

#include <cstdint>
#include <string>

#include "sarn_common/grid.h"
#include "sarn_common/pose2d.h"
#include "social_costmap/scan.h"

// Pure functions between messages and core values. Maps and predictions: sarn_common_ros/conversions.h.
namespace social_costmap_ros {

/// `sensor_in_map`: pose of the scan's frame at its stamp. Use social_costmap::problem() on the result.
[[nodiscard]] social_costmap::Scan fromMessage(const sensor_msgs::LaserScan& message,
                                               const sarn::Pose2D& sensor_in_map);

/// Cost [0, 255] as RViz's costmap colours expect it, costmap_2d's convention: 0 free, 1..98 graded, 99
/// inscribed, 100 lethal, -1 unknown.
[[nodiscard]] std::int8_t occupancyOfCost(std::uint8_t cost);

/// `cells` row-major, geometry.size() of them; stamp [s].
[[nodiscard]] nav_msgs::OccupancyGrid toMessage(const sarn::GridGeometry& geometry, const std::uint8_t* cells,
                                                const std::string& frame, double stamp);

}  // namespace social_costmap_ros
