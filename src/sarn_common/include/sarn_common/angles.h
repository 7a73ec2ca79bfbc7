// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sarn {

inline constexpr double kPi = 3.14159265358979323846;

/// Equivalent of `angle` [rad] in (-pi, pi].
[[nodiscard]] inline double wrapAngle(double angle) {
  if (angle > -kPi && angle <= kPi) return angle;
  const double wrapped = std::remainder(angle, 2.0 * kPi);  // [-pi, pi]
  return wrapped <= -kPi ? kPi : wrapped;
}

/// Shortest rotation from `from` to `to` [rad], in (-pi, pi].
[[nodiscard]] inline double angleDifference(double from, double to) { return wrapAngle(to - from); }

}  // namespace sarn
