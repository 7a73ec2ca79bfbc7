// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/kobuki_sensors.h"

#include <cmath>

#include "sarn_common/angles.h"

namespace kobuki_sim {

std::optional<std::uint8_t> bumperBit(double bearing) {
  constexpr double kCentreEdge = sarn::kPi / 6.0;
  constexpr double kSideEdge = sarn::kPi / 2.0;
  const double angle = sarn::wrapAngle(bearing);
  if (std::abs(angle) <= kCentreEdge) return kCentreBit;
  if (std::abs(angle) > kSideEdge) return std::nullopt;
  return angle > 0.0 ? kLeftBit : kRightBit;
}

}  // namespace kobuki_sim
