// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// Velocity command as the Kobuki's driver sends it to the firmware. radius 0: straight on at `speed`; radius
/// 1: spin on the spot, `speed` of the right wheel; otherwise `speed` of the outer wheel on a circle of
/// `radius` (positive: to the left) of the robot's centre.
struct BaseCommand {
  std::int16_t speed = 0;   // [mm/s]
  std::int16_t radius = 0;  // [mm]
};

/// What the driver makes of a twist: fractions are cut off and both values limited to the range of int16.
[[nodiscard]] BaseCommand encodeCommand(const sarn::Twist2D& twist, double wheel_separation);

/// The twist that the firmware drives for a command.
[[nodiscard]] sarn::Twist2D decodeCommand(const BaseCommand& command, double wheel_separation);

}  // namespace kobuki_sim
