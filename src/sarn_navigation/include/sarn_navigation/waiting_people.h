// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sarn_common/people.h"

namespace sarn_navigation {

/// The prediction with people who stop in front of the robot. Nobody walks through a robot, but a prediction
/// at constant velocity does, and then every plan to get out of somebody's way begins with a collision.
/// Whoever is predicted to come nearer to `robot` [m] than `distance` [m], or than they are now, stays from
/// then on where they were last before.
[[nodiscard]] sarn::PeoplePrediction waitingInFrontOf(const Eigen::Vector2d& robot, double distance,
                                                      sarn::PeoplePrediction people);

}  // namespace sarn_navigation
