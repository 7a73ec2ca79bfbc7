// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/scan.h"

#include <cmath>

namespace social_costmap {

std::optional<std::string> problem(const Scan& scan) {
  const sarn::Pose2D& p = scan.sensor_in_map;
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.theta)) {
    return "scan: the sensor's pose is not finite";
  }
  if (!std::isfinite(scan.stamp)) return "scan: the stamp is not finite";
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) {
    return "scan: angle_min or angle_increment is not finite";
  }
  if (!std::isfinite(scan.range_min) || std::isnan(scan.range_max) || scan.range_min < 0.0 ||
      scan.range_max <= scan.range_min) {
    return "scan: needs 0 <= range_min < range_max, got " + std::to_string(scan.range_min) + " and " +
           std::to_string(scan.range_max);
  }
  return std::nullopt;
}

}  // namespace social_costmap
