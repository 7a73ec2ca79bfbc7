// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/static_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sarn_common/distance_transform.h"

namespace kobuki_sim {
namespace {

constexpr double kSqrt2 = 1.41421356237309504880;

Eigen::Vector2d closestInGrid(const sarn::GridGeometry& grid, const Eigen::Vector2d& p) {
  return {std::clamp(p.x(), grid.origin_x, grid.origin_x + grid.width * grid.resolution),
          std::clamp(p.y(), grid.origin_y, grid.origin_y + grid.height * grid.resolution)};
}

/// Cell of a point of the closed rectangle of the grid; its upper edges belong to the last cells.
sarn::CellIndex clampedCell(const sarn::GridGeometry& grid, const Eigen::Vector2d& p) {
  const sarn::CellIndex cell = grid.cellAtUnbounded(p.x(), p.y());
  return {std::clamp(cell.x, 0, grid.width - 1), std::clamp(cell.y, 0, grid.height - 1)};
}

/// Shortest way out of a cell's square for a point inside of it, and its direction.
std::pair<double, Eigen::Vector2d> wayOutOfCell(const sarn::GridGeometry& grid, int x, int y,
                                                const Eigen::Vector2d& p) {
  const double left = p.x() - (grid.origin_x + x * grid.resolution);
  const double down = p.y() - (grid.origin_y + y * grid.resolution);
  const std::pair<double, Eigen::Vector2d> ways[] = {{left, {-1.0, 0.0}},
                                                     {grid.resolution - left, {1.0, 0.0}},
                                                     {down, {0.0, -1.0}},
                                                     {grid.resolution - down, {0.0, 1.0}}};
  return *std::min_element(std::begin(ways), std::end(ways),
                           [](const auto& a, const auto& b) { return a.first < b.first; });
}

}  // namespace

StaticMap::StaticMap(sarn::OccupancyMap map) : map_(std::move(map)) {
  sarn::Grid<std::uint8_t> walls(map_.geometry, 0);
  for (std::size_t i = 0; i < walls.cells.size(); ++i)
    walls.cells[i] = map_.cells[i] == sarn::kMapOccupied ? 1 : 0;
  distance_ = sarn::distanceTransform(walls);
}

StaticMap StaticMap::load(const std::filesystem::path& yaml_file) {
  return StaticMap(sarn::loadMap(yaml_file));
}

bool StaticMap::occupied(const Eigen::Vector2d& point) const {
  const auto cell = map_.geometry.cellAt(point.x(), point.y());
  return cell && map_.at(*cell) == sarn::kMapOccupied;
}

double StaticMap::clearanceLowerBound(const Eigen::Vector2d& point) const {
  if (empty()) return std::numeric_limits<double>::infinity();
  if (!point.allFinite()) return 0.0;
  const Eigen::Vector2d inside = closestInGrid(map_.geometry, point);
  // Projection on the convex grid brings a point no farther from any wall. Inside, half a diagonal at either
  // end lies between the distance of two centres and that of the point and the wall.
  const double bound = centerDistance(inside) - kSqrt2 * map_.geometry.resolution;
  return std::max({bound, (point - inside).norm(), 0.0});
}

double StaticMap::centerDistance(const Eigen::Vector2d& inside) const {
  return static_cast<double>(distance_.at(clampedCell(map_.geometry, inside)));
}

std::optional<WallPoint> StaticMap::nearestWall(const Eigen::Vector2d& point, double max_distance) const {
  if (!point.allFinite() || clearanceLowerBound(point) > max_distance) return std::nullopt;
  const Eigen::Vector2d inside = closestInGrid(map_.geometry, point);
  // Over the point's cell's centre to the nearest occupied centre: no wall need be sought farther away.
  const double bound =
      (point - inside).norm() + centerDistance(inside) + 0.5 * kSqrt2 * map_.geometry.resolution;
  if (!std::isfinite(bound)) return std::nullopt;  // a map without walls
  std::optional<WallPoint> nearest;
  forEachWallWithin(point, std::min(max_distance, bound),
                    [&](const sarn::CellIndex&, const Eigen::Vector2d& closest, double distance) {
                      if (!nearest || distance < nearest->distance) nearest = WallPoint{distance, closest};
                    });
  return nearest;
}

bool StaticMap::discFree(const Eigen::Vector2d& center, double radius) const {
  const auto wall = nearestWall(center, radius);
  return !wall || wall->distance >= radius;
}

Eigen::Vector2d StaticMap::pushOut(const Eigen::Vector2d& center, double radius) const {
  constexpr int kMaxPushes = 64;
  Eigen::Vector2d p = center;
  for (int i = 0; i < kMaxPushes; ++i) {
    const auto wall = nearestWall(p, radius);
    if (!wall || wall->distance >= radius) return p;
    if (wall->distance > 1e-9) {
      // A hair more than needed, so that rounding does not leave it inside.
      p = wall->point + (p - wall->point) * ((radius + 1e-9) / wall->distance);
    } else {
      const auto cell = map_.geometry.cellAt(p.x(), p.y());
      const auto way = cell ? wayOutOfCell(map_.geometry, cell->x, cell->y, p)
                            : std::pair<double, Eigen::Vector2d>{0.0, {1.0, 0.0}};
      p += (way.first + 1e-6) * way.second;
    }
  }
  return p;
}

std::optional<RayHit> StaticMap::rayCast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                         double max_range) const {
  const sarn::GridGeometry& grid = map_.geometry;
  if (empty() || !origin.allFinite() || !direction.allFinite()) return std::nullopt;
  // Clip the ray to the grid's rectangle (slab method), so that a ray from outside enters it.
  double t_in = 0.0;
  double t_out = max_range;
  const double low[] = {grid.origin_x, grid.origin_y};
  const double high[] = {grid.origin_x + grid.width * grid.resolution,
                         grid.origin_y + grid.height * grid.resolution};
  int entered_axis = -1;
  for (const int axis : {0, 1}) {
    const double d = direction[axis];
    if (d == 0.0) {
      if (origin[axis] < low[axis] || origin[axis] >= high[axis]) return std::nullopt;
      continue;
    }
    const double a = ((d > 0.0 ? low[axis] : high[axis]) - origin[axis]) / d;
    const double b = ((d > 0.0 ? high[axis] : low[axis]) - origin[axis]) / d;
    if (a > t_in) {
      t_in = a;
      entered_axis = axis;
    }
    t_out = std::min(t_out, b);
  }
  if (t_in > t_out) return std::nullopt;

  const Eigen::Vector2d start = origin + t_in * direction;
  const int step[] = {direction.x() > 0.0 ? 1 : -1, direction.y() > 0.0 ? 1 : -1};
  int cell[] = {
      std::clamp(static_cast<int>(std::floor((start.x() - low[0]) / grid.resolution)), 0, grid.width - 1),
      std::clamp(static_cast<int>(std::floor((start.y() - low[1]) / grid.resolution)), 0, grid.height - 1)};
  double t_next[2];
  double t_cell[2];
  for (const int axis : {0, 1}) {
    const double d = direction[axis];
    const double edge = low[axis] + (cell[axis] + (step[axis] > 0 ? 1 : 0)) * grid.resolution;
    t_next[axis] = d != 0.0 ? (edge - origin[axis]) / d : std::numeric_limits<double>::infinity();
    t_cell[axis] = d != 0.0 ? grid.resolution / std::abs(d) : std::numeric_limits<double>::infinity();
  }
  double t = t_in;
  int axis = entered_axis;
  while (true) {
    if (map_.at({cell[0], cell[1]}) == sarn::kMapOccupied) {
      RayHit hit{t, origin + t * direction, Eigen::Vector2d::Zero()};
      if (axis >= 0) hit.normal[axis] = -step[axis];
      return hit;
    }
    axis = t_next[0] < t_next[1] ? 0 : 1;
    t = t_next[axis];
    cell[axis] += step[axis];
    t_next[axis] += t_cell[axis];
    if (t > t_out || !grid.contains({cell[0], cell[1]})) return std::nullopt;
  }
}

bool StaticMap::segmentFree(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const double length = (b - a).norm();
  if (length == 0.0) return !occupied(a);
  return !rayCast(a, (b - a) / length, length);
}

}  // namespace kobuki_sim
