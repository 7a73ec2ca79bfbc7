// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sarn_common/map_io.h"

namespace sarn_perception {

struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.25;                              // [m] > 0
};

/// Whether no occupied cell of the map lies on the segment; an empty map has no walls, and outside the map
/// there are none. The cell of `to` itself does not count: a person may lean on a wall.
[[nodiscard]] bool lineOfSight(const sarn::OccupancyMap& map, const Eigen::Vector2d& from,
                               const Eigen::Vector2d& to);

/// Whether the segment passes through the disc; false when it starts inside.
[[nodiscard]] bool crossesDisc(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Disc& disc);

/// Share [0, 1] of a disc's width, as seen from a point, that neither walls nor other discs hide: of nine
/// lines of sight spread over its diameter.
[[nodiscard]] double visibleShare(const sarn::OccupancyMap& map, const Eigen::Vector2d& from,
                                  const Disc& target, const std::vector<Disc>& others);

}  // namespace sarn_perception
