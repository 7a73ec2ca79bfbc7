// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/scan_beams.h"

#include <algorithm>
#include <cmath>

namespace sarn_localization {
namespace {

std::vector<std::size_t> usableBeams(const PlanarScan& scan, const BeamLimits& limits) {
  const double low = std::max(scan.range_min, limits.min_range);
  const double high = std::min(scan.range_max, limits.max_range);
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const auto range = static_cast<double>(scan.ranges[i]);
    if (range >= low && range <= high) usable.push_back(i);  // false for NaN
  }
  return usable;
}

}  // namespace

ScanBeams selectBeams(const PlanarScan& scan, const sarn::Pose2D& base_from_sensor,
                      const BeamLimits& limits) {
  ScanBeams result;
  result.origin = base_from_sensor.position();
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) return result;
  const std::vector<std::size_t> usable = usableBeams(scan, limits);
  const std::size_t count = std::min(usable.size(), limits.max_beams);
  result.beams.reserve(count);
  if (!scan.ranges.empty()) {
    result.coverage = static_cast<double>(usable.size()) / static_cast<double>(scan.ranges.size());
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = usable[(2 * k + 1) * usable.size() / (2 * count)];
    const double angle = base_from_sensor.theta + scan.angle_min +
                         (static_cast<double>(i) + limits.beam_offset) * scan.angle_increment;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const auto measured = static_cast<double>(scan.ranges[i]);
    const double range = measured + limits.range_bias * measured * measured;
    result.beams.push_back({result.origin + range * direction, direction, range});
  }
  return result;
}

}  // namespace sarn_localization
