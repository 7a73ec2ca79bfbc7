// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace kobuki_sim {

/// The robot as people see it, in map.
struct RobotDisc {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double radius = 0.17575;                             // [m] hull of a Kobuki
};

}  // namespace kobuki_sim
