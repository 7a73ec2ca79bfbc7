// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/static_map.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// What solid things leave of a step of the robot.
struct RobotStep {
  sarn::Pose2D pose;                                   // in map, after the step
  sarn::Twist2D twist;                                 // in base_footprint, really driven
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] in map, really driven
  bool blocked = false;                                // something held the robot back
};

/// Moves a disc of `radius` [m] with a twist for dt [s]. It slides along walls and around people and never
/// enters a wall. It does not press into a person either; a person who has walked into it does not move it,
/// but it can drive away. Turning is always free.
[[nodiscard]] RobotStep moveRobot(const sarn::Pose2D& pose, const sarn::Twist2D& wanted, double dt,
                                  double radius, const StaticMap& map,
                                  const std::vector<PersonState>& people);

/// Bumper bits pressed by every wall and person within `tolerance` [m] of the hull.
[[nodiscard]] std::uint8_t pressedBumpers(const sarn::Pose2D& pose, double radius, double tolerance,
                                          const StaticMap& map, const std::vector<PersonState>& people);

}  // namespace kobuki_sim
