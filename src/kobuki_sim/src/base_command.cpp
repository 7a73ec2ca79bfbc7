// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/base_command.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kobuki_sim {
namespace {

constexpr double kStraightBelow = 1e-4;  // [rad/s]
constexpr double kSpinBelow = 1e-4;      // [m/s]

std::int16_t truncated(double value) {
  constexpr double low = std::numeric_limits<std::int16_t>::min();
  constexpr double high = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::clamp(value, low, high));
}

}  // namespace

BaseCommand encodeCommand(const sarn::Twist2D& twist, double wheel_separation) {
  if (std::abs(twist.omega) < kStraightBelow) return {truncated(1000.0 * twist.v), 0};
  const double half_track = 500.0 * wheel_separation;    // [mm]
  const double radius = 1000.0 * twist.v / twist.omega;  // [mm]
  if (std::abs(twist.v) < kSpinBelow || std::abs(radius) <= 1.0)
    return {truncated(half_track * twist.omega), 1};
  const double outer = radius > 0.0 ? radius + half_track : radius - half_track;
  return {truncated(outer * twist.omega), truncated(radius)};
}

sarn::Twist2D decodeCommand(const BaseCommand& command, double wheel_separation) {
  const double speed = command.speed / 1000.0;  // [m/s]
  if (command.radius == 0) return {speed, 0.0};
  if (command.radius == 1) return {0.0, speed / (0.5 * wheel_separation)};
  const double radius = command.radius / 1000.0;  // [m]
  const double outer = radius > 0.0 ? radius + 0.5 * wheel_separation : radius - 0.5 * wheel_separation;
  const double omega = speed / outer;
  return {radius * omega, omega};
}

}  // namespace kobuki_sim
