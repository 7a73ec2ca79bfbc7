// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sarn_common/grid.h"
#include "sarn_common/map_io.h"

namespace sarn_localization {

/// Distances to the walls of a map, fast enough for many particles.
class WallDistance {
 public:
  /// Occupancy from 65 up is a wall, as in map_server's files. Throws std::invalid_argument on a map without
  /// a single wall or a single free cell.
  explicit WallDistance(const sarn::OccupancyMap& map);

  /// Distance [m] from a point to the surface of the nearest wall, from within a wall too (a return comes
  /// from a surface, not from the depth of a wall); bilinear between cells; `cut` [m] at most and outside the
  /// map.
  [[nodiscard]] double at(const Eigen::Vector2d& point, double cut) const;

  /// Length [m] of a ray until it meets a wall, max_range at most. `direction` is a unit vector.
  [[nodiscard]] double castRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                               double max_range) const;

  /// Whether a robot's centre can be there: not in a wall.
  [[nodiscard]] bool open(const Eigen::Vector2d& point) const;

  [[nodiscard]] const std::vector<sarn::CellIndex>& freeCells() const { return free_cells_; }
  [[nodiscard]] const sarn::GridGeometry& geometry() const { return distance_.geometry; }

 private:
  /// Bilinear between cells; outside the map `outside`.
  [[nodiscard]] double interpolated(const Eigen::Vector2d& point, double outside) const;

  sarn::Grid<float>
      distance_;  // [m] from a cell's centre to the surface of the nearest wall; negative within
  std::vector<sarn::CellIndex> free_cells_;
};

inline double WallDistance::interpolated(const Eigen::Vector2d& point, double outside) const {
  const sarn::GridGeometry& grid = distance_.geometry;
  const double u = (point.x() - grid.origin_x) / grid.resolution - 0.5;
  const double v = (point.y() - grid.origin_y) / grid.resolution - 0.5;
  if (!(u >= 0.0 && v >= 0.0 && u < grid.width - 1 && v < grid.height - 1)) return outside;
  const auto x = static_cast<int>(u);
  const auto y = static_cast<int>(v);
  const double fx = u - x;
  const double fy = v - y;
  const float* row = &distance_.cells[grid.index({x, y})];
  const float* above = row + grid.width;
  const double low = static_cast<double>(row[0]) * (1.0 - fx) + static_cast<double>(row[1]) * fx;
  const double high = static_cast<double>(above[0]) * (1.0 - fx) + static_cast<double>(above[1]) * fx;
  return low * (1.0 - fy) + high * fy;
}

inline double WallDistance::at(const Eigen::Vector2d& point, double cut) const {
  return std::min(std::abs(interpolated(point, cut)), cut);
}

}  // namespace sarn_localization
