// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/visibility.h"

#include <algorithm>
#include <cmath>

namespace sarn_perception {

bool lineOfSight(const sarn::OccupancyMap& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  if (map.cells.empty()) return true;
  const sarn::CellIndex last = map.geometry.cellAtUnbounded(to.x(), to.y());
  bool open = true;
  sarn::traverseCells(map.geometry, from, to, [&](const sarn::CellIndex& cell) {
    if (cell == last) return false;
    open = !(map.geometry.contains(cell) && map.at(cell) == sarn::kMapOccupied);
    return open;
  });
  return open;
}

bool crossesDisc(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Disc& disc) {
  const Eigen::Vector2d way = to - from;
  const Eigen::Vector2d center = disc.center - from;
  if (center.norm() <= disc.radius) return false;
  const double length_squared = way.squaredNorm();
  const double nearest = length_squared > 0.0 ? std::clamp(center.dot(way) / length_squared, 0.0, 1.0) : 0.0;
  return (center - nearest * way).norm() < disc.radius;
}

double visibleShare(const sarn::OccupancyMap& map, const Eigen::Vector2d& from, const Disc& target,
                    const std::vector<Disc>& others) {
  constexpr int kLines = 9;
  const Eigen::Vector2d way = target.center - from;
  const double distance = way.norm();
  if (distance <= target.radius) return 1.0;
  const Eigen::Vector2d across = Eigen::Vector2d(-way.y(), way.x()) / distance;
  int open = 0;
  for (int i = 0; i < kLines; ++i) {
    const double offset = target.radius * (2.0 * (i + 0.5) / kLines - 1.0);
    const Eigen::Vector2d to = target.center + offset * across;
    const bool hidden = std::any_of(others.begin(), others.end(),
                                    [&](const Disc& other) { return crossesDisc(from, to, other); });
    open += !hidden && lineOfSight(map, from, to) ? 1 : 0;
  }
  return static_cast<double>(open) / kLines;
}

}  // namespace sarn_perception
