// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sarn_common/pose2d.h"

// The area that a disc sweeps along a circular arc, and what lies in it. Free functions on plain values;
// points in base_footprint, the disc's centre at the origin.
namespace sarn_navigation {

/// Distance driven until a robot at speed `v` stands: |v| t + v^2 / (2 a), with reaction time `t` [s] and
/// deceleration `a` [m/s^2] > 0. [m]
[[nodiscard]] double stoppingDistance(double v, double reaction_time, double deceleration);

/// The speed [m/s] >= 0 whose stopping distance is `distance` [m] >= 0: the inverse of stoppingDistance.
[[nodiscard]] double speedThatStopsWithin(double distance, double reaction_time, double deceleration);

/// Path length [m] that the centre of a disc of `radius` [m] can drive along the arc of constant `twist`
/// before the disc touches `point`; infinity when it never does, and when twist.v is zero (a disc that turns
/// in place sweeps nothing). A point that lies inside the disc already counts as touched only when the robot
/// comes closer to it, so that the robot can leave a contact or pass along it.
[[nodiscard]] double freeDistance(const sarn::Twist2D& twist, const Eigen::Vector2d& point, double radius);

}  // namespace sarn_navigation
