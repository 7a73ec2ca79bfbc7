// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/wall_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_common/distance_transform.h"

namespace sarn_perception {
namespace {

/// Moves by at most half a cell.
void shortStep(const WallField& walls, double clearance, bool slide, double dt, Walker& walker) {
  const double here = walls.distance(walker.position);
  const auto free = [&](const Eigen::Vector2d& velocity) {
    const double there = walls.distance(walker.position + dt * velocity);
    return there >= clearance || (there >= here && there > 0.0);
  };
  if (!free(walker.velocity)) {
    Eigen::Vector2d along_x(walker.velocity.x(), 0.0);
    Eigen::Vector2d along_y(0.0, walker.velocity.y());
    if (along_x.norm() < along_y.norm()) std::swap(along_x, along_y);
    const bool first = slide && free(along_x) && along_x.norm() > 0.0;
    const bool second = slide && free(along_y) && along_y.norm() > 0.0;
    walker.velocity = first ? along_x : second ? along_y : Eigen::Vector2d::Zero();
  }
  walker.position += dt * walker.velocity;
}

}  // namespace

WallField::WallField(const sarn::OccupancyMap& map) {
  sarn::Grid<std::uint8_t> occupied(map.geometry, 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    occupied.cells[i] = map.cells[i] == sarn::kMapOccupied ? 1 : 0;
  distance_ = sarn::distanceTransform(occupied);
}

double WallField::distance(const Eigen::Vector2d& point) const {
  const auto cell = distance_.geometry.cellAt(point.x(), point.y());
  return cell ? static_cast<double>(distance_.at(*cell)) : std::numeric_limits<double>::infinity();
}

void walk(const WallField& walls, double clearance, bool slide, double dt, Walker& walker) {
  const double way = walker.velocity.norm() * dt;
  const int steps = std::max(1, static_cast<int>(std::ceil(way / (0.5 * walls.resolution()))));
  for (int i = 0; i < steps; ++i) shortStep(walls, clearance, slide, dt / steps, walker);
}

}  // namespace sarn_perception
