// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/wall_distance.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "sarn_common/distance_transform.h"

namespace sarn_localization {
namespace {

constexpr std::int8_t kWall = 65;  // [%] occupancy
constexpr std::int8_t kFree = 20;  // [%]

}  // namespace

WallDistance::WallDistance(const sarn::OccupancyMap& map) {
  sarn::Grid<std::uint8_t> walls(map.geometry, 0);
  bool any_wall = false;
  for (int y = 0; y < map.geometry.height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      const std::int8_t occupancy = map.at({x, y});
      if (occupancy >= kWall) {
        walls.at({x, y}) = 1;
        any_wall = true;
      } else if (occupancy >= 0 && occupancy < kFree) {
        free_cells_.push_back({x, y});
      }
    }
  }
  if (!any_wall || free_cells_.empty()) {
    throw std::invalid_argument("map: needs at least one occupied and one free cell to localise in");
  }
  distance_ = sarn::distanceTransform(walls);
  for (std::uint8_t& cell : walls.cells) cell = cell == 0 ? 1 : 0;
  const sarn::Grid<float> within = sarn::distanceTransform(walls);
  const auto half = static_cast<float>(0.5 * map.geometry.resolution);
  for (std::size_t i = 0; i < distance_.cells.size(); ++i) {
    distance_.cells[i] = distance_.cells[i] > 0.0F ? distance_.cells[i] - half : half - within.cells[i];
  }
}

double WallDistance::castRay(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                             double max_range) const {
  const double step = 0.5 * geometry().resolution;
  double t = 0.0;
  while (t < max_range) {
    const double clearance = interpolated(origin + t * direction, max_range);
    if (clearance < 0.1 * step) return t;
    t += std::max(clearance, 0.2 * step);
  }
  return max_range;
}

bool WallDistance::open(const Eigen::Vector2d& point) const {
  const auto cell = geometry().cellAt(point.x(), point.y());
  return cell && distance_.at(*cell) > 0.0F;
}

}  // namespace sarn_localization
