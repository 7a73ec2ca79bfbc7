// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// Where a body that starts at `position` and tries to move by `displacement` [m] gets to: it slides along
/// walls and never overlaps one (a body that overlaps a wall already never gets deeper). Without a map (null)
/// all is open.
[[nodiscard]] Eigen::Vector2d moveAmongWalls(const StaticMap* map, const Eigen::Vector2d& position,
                                             const Eigen::Vector2d& displacement, double radius);

/// Whether a body can walk straight from a to b.
[[nodiscard]] bool canWalkStraight(const StaticMap* map, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                   double radius);

}  // namespace kobuki_sim
