// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/escape_zone.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lattice_planner {

void EscapeZone::reset(const sarn::TimedCostmapView& costmap, const std::array<bool, 256>& forbidden_static,
                       const std::array<bool, 256>& forbidden_social, const sarn::CellIndex& start,
                       double time, double radius) {
  costmap_ = &costmap;
  forbidden_static_ = &forbidden_static;
  forbidden_social_ = &forbidden_social;
  center_ = start;
  half_ = static_cast<int>(std::ceil(radius / costmap.geometry.resolution));
  static_active_ = forbidden_static[costmap.static_costs[costmap.geometry.index(start)]];
  active_ = forbidden(start, costmap.layerAt(time));
  depth_.assign(active_ ? costmap.layers.size() + 1 : 0, {});
}

bool EscapeZone::inWindow(const sarn::CellIndex& cell) const {
  return std::abs(cell.x - center_.x) <= half_ && std::abs(cell.y - center_.y) <= half_;
}

bool EscapeZone::exemptsStatic(const sarn::CellIndex& cell) const {
  return static_active_ && inWindow(cell) &&
         costmap_->static_costs[costmap_->geometry.index(cell)] != sarn::kLethalObstacle;
}

bool EscapeZone::forbidden(const sarn::CellIndex& cell, int layer) const {
  const std::size_t index = costmap_->geometry.index(cell);
  return (*forbidden_static_)[costmap_->static_costs[index]] ||
         (layer >= 0 && (*forbidden_social_)[costmap_->layers[static_cast<std::size_t>(layer)][index]]);
}

std::size_t EscapeZone::local(const sarn::CellIndex& cell) const {
  return static_cast<std::size_t>((cell.y - center_.y + half_) * (2 * half_ + 1) + cell.x - center_.x +
                                  half_);
}

const std::vector<int>& EscapeZone::depths(int layer) {
  std::vector<int>& depth = depth_[static_cast<std::size_t>(layer + 1)];
  if (!depth.empty()) return depth;
  const int side = 2 * half_ + 1;
  depth.assign(static_cast<std::size_t>(side * side), 0);
  const auto value = [&](int x, int y) -> int {
    if (x < 0 || y < 0 || x >= side || y >= side)
      return side;  // unknown: no way out through the window's edge
    return depth[static_cast<std::size_t>(y * side + x)];
  };
  const auto relax = [&](int x, int y, int sign) {
    int& here = depth[static_cast<std::size_t>(y * side + x)];
    const int least =
        std::min({value(x - sign, y), value(x - 1, y - sign), value(x, y - sign), value(x + 1, y - sign)});
    here = std::min(here, least + 1);
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const sarn::CellIndex cell{center_.x - half_ + x, center_.y - half_ + y};
      const bool blocked = !costmap_->geometry.contains(cell) || forbidden(cell, layer);
      depth[static_cast<std::size_t>(y * side + x)] = blocked ? side : 0;
    }
  }
  // Two passes of the chessboard distance transform (Rosenfeld and Pfaltz 1968).
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) relax(x, y, 1);
  }
  for (int y = side - 1; y >= 0; --y) {
    for (int x = side - 1; x >= 0; --x) relax(x, y, -1);
  }
  return depth;
}

bool EscapeZone::allows(const sarn::CellIndex& from, const sarn::CellIndex& to, int layer) {
  if (!active_ || !inWindow(from) || !inWindow(to)) return false;
  const std::uint8_t cost = costmap_->static_costs[costmap_->geometry.index(to)];
  if (cost == sarn::kLethalObstacle) return false;
  if ((*forbidden_static_)[cost] && !static_active_) return false;
  const std::vector<int>& depth = depths(layer);
  return depth[local(to)] <= depth[local(from)];
}

}  // namespace lattice_planner
