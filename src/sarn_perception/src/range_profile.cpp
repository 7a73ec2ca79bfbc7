// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/range_profile.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_perception {
namespace {

constexpr int kLines = 9;  // of sight across a disc

/// Range at a bearing [rad]; NaN beside the view.
float rangeAt(const RangeProfile& profile, double bearing) {
  // The first bearing at or after angle_min, whatever turn it was given in.
  double turn = std::fmod(bearing - profile.angle_min, 2.0 * sarn::kPi);
  if (turn < -0.5 * profile.angle_increment) turn += 2.0 * sarn::kPi;
  const double index = std::round(turn / profile.angle_increment);
  if (!(index >= 0.0 && index < static_cast<double>(profile.ranges.size()))) return std::nanf("");
  return profile.ranges[static_cast<std::size_t>(index)];
}

}  // namespace

Sight lookAt(const RangeProfile& profile, const Eigen::Vector2d& center, double radius) {
  Sight sight;
  const double distance = center.norm();
  if (distance <= radius || distance + radius > profile.max_range) return sight;
  const double bearing = std::atan2(center.y(), center.x());
  const double half = std::asin(radius / distance);
  for (int i = 0; i < kLines; ++i) {
    const float range = rangeAt(profile, bearing + half * (2.0 * (i + 0.5) / kLines - 1.0));
    if (std::isnan(range)) continue;
    if (static_cast<double>(range) > distance + radius)
      sight.through += 1.0 / kLines;
    else if (static_cast<double>(range) > distance - 2.0 * radius)
      sight.onto += 1.0 / kLines;
  }
  return sight;
}

}  // namespace sarn_perception
