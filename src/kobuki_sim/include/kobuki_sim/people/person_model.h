// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "kobuki_sim/scenario.h"

namespace kobuki_sim {

/// A person of the world at one time, in map.
struct PersonState {
  int id = 0;         // index in Crowd::people(), constant over a run
  std::string name;   // unique
  std::string group;  // empty: alone
  PersonModel model = PersonModel::kOrca;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] centre
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] of the last step's real motion
  double heading = 0.0;                                // [rad] where the torso faces
  double radius = 0.25;                                // [m]
  double preferred_speed = 1.0;                        // [m/s]
  bool reacts_to_robot = true;
  bool present = true;  // false: not in the world now (a replayed person before or after the recording)
  double walking_phase = 0.0;  // [rad] of the gait, in [0, 2 pi); moves the legs that the depth camera sees
};

}  // namespace kobuki_sim
