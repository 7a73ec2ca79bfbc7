// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/scan_beams.h"

#include <algorithm>
#include <cmath>

namespace sarn_localization {
namespace {

struct Indices {
  std::vector<std::size_t> usable;
  std::vector<std::size_t> silent;
};

Indices sortBeams(const PlanarScan& scan, const BeamLimits& limits) {
  const double low = std::max(scan.range_min, limits.min_range);
  const double high = std::min(scan.range_max, limits.max_range);
  Indices indices;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const auto range = static_cast<double>(scan.ranges[i]);
    const bool usable = range >= low && range <= high;  // false for NaN
    (usable ? indices.usable : indices.silent).push_back(i);
  }
  return indices;
}

/// At most `count` of them, evenly spread.
std::vector<std::size_t> evenly(const std::vector<std::size_t>& indices, std::size_t count) {
  if (indices.size() <= count) return indices;
  std::vector<std::size_t> some(count);
  for (std::size_t k = 0; k < count; ++k) some[k] = indices[(2 * k + 1) * indices.size() / (2 * count)];
  return some;
}

}  // namespace

ScanBeams selectBeams(const PlanarScan& scan, const sarn::Pose2D& base_from_sensor,
                      const BeamLimits& limits) {
  ScanBeams result;
  result.origin = base_from_sensor.position();
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) return result;
  result.reach = std::min(scan.range_max, limits.max_range);
  const auto [usable, silent] = sortBeams(scan, limits);
  if (!scan.ranges.empty()) {
    result.coverage = static_cast<double>(usable.size()) / static_cast<double>(scan.ranges.size());
  }
  const auto direction_of = [&](std::size_t i) {
    const double angle = base_from_sensor.theta + scan.angle_min +
                         (static_cast<double>(i) + limits.beam_offset) * scan.angle_increment;
    return Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  for (const std::size_t i : evenly(silent, limits.max_silent)) result.silent.push_back(direction_of(i));
  for (const std::size_t i : evenly(usable, limits.max_beams)) {
    const Eigen::Vector2d direction = direction_of(i);
    const auto measured = static_cast<double>(scan.ranges[i]);
    const double range = measured + limits.range_bias * measured * measured;
    result.beams.push_back({result.origin + range * direction, direction, range});
  }
  return result;
}

ScanBeams everyFewBeams(const ScanBeams& scan, std::size_t count) {
  if (scan.beams.size() <= count) return scan;
  ScanBeams few;
  few.origin = scan.origin;
  few.coverage = scan.coverage;
  few.beams.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    few.beams.push_back(scan.beams[(2 * k + 1) * scan.beams.size() / (2 * count)]);
  }
  return few;
}

}  // namespace sarn_localization
