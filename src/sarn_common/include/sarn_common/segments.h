// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace sarn {

/// Distance [m] from p to the segment between a and b, which may be one point; all in one frame.
[[nodiscard]] inline double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                              const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double squared = way.squaredNorm();
  const double share = squared > 0.0 ? std::clamp((p - a).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (p - a - share * way).norm();
}

}  // namespace sarn
