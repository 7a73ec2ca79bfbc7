// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
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

  /// Whether a disc touches no wall.
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
  sarn::OccupancyMap map_;
  sarn::Grid<float> distance_;
};

}  // namespace kobuki_sim
