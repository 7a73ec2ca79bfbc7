// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sarn_common/grid.h"
#include "sarn_common/map_io.h"

namespace sarn_perception {

/// Distance to the nearest occupied cell of a map; open space without a map and outside it.
class WallField {
 public:
  WallField() = default;
  explicit WallField(const sarn::OccupancyMap& map);

  /// From the centre of the point's cell to that of the nearest wall [m]; 0 in a wall.
  [[nodiscard]] double distance(const Eigen::Vector2d& point) const;
  /// Edge of a cell [m].
  [[nodiscard]] double resolution() const { return distance_.geometry.resolution; }

 private:
  sarn::Grid<float> distance_;
};

/// A person on the way at constant velocity.
struct Walker {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
};

/// Moves a walker for dt [s]. It comes no nearer to a wall than `clearance` [m] (one that is nearer already
/// does not come nearer still). At a wall it keeps, with `slide`, the component of its velocity along the
/// grid axis that is free; otherwise, and when neither is free, it stands.
void walk(const WallField& walls, double clearance, bool slide, double dt, Walker& walker);

}  // namespace sarn_perception
