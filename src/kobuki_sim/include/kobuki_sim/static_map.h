// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "sarn_common/grid.h"
#include "sarn_common/map_io.h"

namespace kobuki_sim {

/// Where a ray meets a wall, in map.
struct RayHit {
  double distance = 0.0;   // [m] from the ray's origin
  Eigen::Vector2d point;   // [m] on the wall
  Eigen::Vector2d normal;  // unit, out of the wall; zero when the ray starts inside a wall
};

/// The nearest point of a wall, in map.
struct WallPoint {
  double distance = 0.0;  // [m] 0 inside a wall
  Eigen::Vector2d point;  // [m] on the wall
};

/// Walls as the occupied cells of a map: squares with sharp edges. Free, unknown and everything outside the
/// map is open. Without a map all is open space. All queries are exact for the squares, const and free of
/// allocation.
class StaticMap {
 public:
  StaticMap() = default;
  explicit StaticMap(sarn::OccupancyMap map);
  /// Loads a ROS map; throws sarn::MapError.
  [[nodiscard]] static StaticMap load(const std::filesystem::path& yaml_file);

  [[nodiscard]] bool empty() const { return map_.cells.empty(); }
  [[nodiscard]] const sarn::OccupancyMap& map() const { return map_; }
  [[nodiscard]] const sarn::GridGeometry& geometry() const { return map_.geometry; }

  [[nodiscard]] bool occupied(const sarn::CellIndex& cell) const {
    return map_.geometry.contains(cell) && map_.at(cell) == sarn::kMapOccupied;
  }
  [[nodiscard]] bool occupied(const Eigen::Vector2d& point) const;

  /// Centre-to-centre distance [m] from each cell to the nearest occupied cell (the input of fast lower
  /// bounds).
  [[nodiscard]] const sarn::Grid<float>& distanceField() const { return distance_; }
  /// A distance [m] that the nearest wall is surely not closer than; cheap. Infinite in open space.
  [[nodiscard]] double clearanceLowerBound(const Eigen::Vector2d& point) const;

  /// The nearest wall within max_distance [m] of a point.
  [[nodiscard]] std::optional<WallPoint> nearestWall(const Eigen::Vector2d& point, double max_distance) const;

  /// Calls visit(cell, closest point of its square, distance [m]) for each occupied cell within `radius` [m]
  /// of a finite point.
  template <class Visit>
  void forEachWallWithin(const Eigen::Vector2d& point, double radius, Visit&& visit) const;

  /// Whether a disc overlaps no wall.
  [[nodiscard]] bool discFree(const Eigen::Vector2d& center, double radius) const;

  /// The centre nearest to `center` found at which the disc overlaps no wall, by pushing it out of the cells
  /// it overlaps; a disc that is free stays where it is.
  [[nodiscard]] Eigen::Vector2d pushOut(const Eigen::Vector2d& center, double radius) const;

  /// First wall on a ray; `direction` is a unit vector, max_range [m] finite.
  [[nodiscard]] std::optional<RayHit> rayCast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                              double max_range) const;
  /// Whether no wall lies on the segment from a to b.
  [[nodiscard]] bool segmentFree(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

 private:
  /// distanceField() at a point of the grid's closed rectangle [m].
  [[nodiscard]] double centerDistance(const Eigen::Vector2d& inside) const;

  sarn::OccupancyMap map_;
  sarn::Grid<float> distance_;
};

template <class Visit>
void StaticMap::forEachWallWithin(const Eigen::Vector2d& point, double radius, Visit&& visit) const {
  const sarn::GridGeometry& grid = map_.geometry;
  const auto column = [&](double x) {
    return static_cast<int>(
        std::clamp(std::floor((x - grid.origin_x) / grid.resolution), -1.0, grid.width + 0.0));
  };
  const auto row = [&](double y) {
    return static_cast<int>(
        std::clamp(std::floor((y - grid.origin_y) / grid.resolution), -1.0, grid.height + 0.0));
  };
  const int last_x = std::min(grid.width - 1, column(point.x() + radius));
  const int last_y = std::min(grid.height - 1, row(point.y() + radius));
  for (int y = std::max(0, row(point.y() - radius)); y <= last_y; ++y) {
    for (int x = std::max(0, column(point.x() - radius)); x <= last_x; ++x) {
      if (map_.at({x, y}) != sarn::kMapOccupied) continue;
      const double low_x = grid.origin_x + x * grid.resolution;
      const double low_y = grid.origin_y + y * grid.resolution;
      const Eigen::Vector2d closest(std::clamp(point.x(), low_x, low_x + grid.resolution),
                                    std::clamp(point.y(), low_y, low_y + grid.resolution));
      const double distance = (closest - point).norm();
      if (distance <= radius) visit(sarn::CellIndex{x, y}, closest, distance);
    }
  }
}

}  // namespace kobuki_sim
