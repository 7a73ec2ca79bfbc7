// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/reachable_area.h"

#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace sarn_navigation {
namespace {

using Entry = std::pair<float, sarn::CellIndex>;

struct Later {
  bool operator()(const Entry& a, const Entry& b) const { return a.first > b.first; }
};

bool passable(std::uint8_t cost, bool allow_unknown) {
  return cost < sarn::kInscribedObstacle || (allow_unknown && cost == sarn::kNoInformation);
}

}  // namespace

sarn::Grid<float> pathLengths(const sarn::TimedCostmapView& view, const Eigen::Vector2d& from, double limit,
                              bool allow_unknown) {
  const sarn::GridGeometry& grid = view.geometry;
  sarn::Grid<float> lengths(grid, kUnreachable);
  const auto start = grid.cellAt(from.x(), from.y());
  if (!start) return lengths;
  const auto straight = static_cast<float>(grid.resolution);
  const float diagonal = straight * std::sqrt(2.0F);
  std::priority_queue<Entry, std::vector<Entry>, Later> open;
  lengths.at(*start) = 0.0F;
  open.push({0.0F, *start});
  while (!open.empty()) {
    const auto [length, cell] = open.top();
    open.pop();
    if (length > lengths.at(cell)) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const sarn::CellIndex next{cell.x + dx, cell.y + dy};
        if (!grid.contains(next) || !passable(view.static_costs[grid.index(next)], allow_unknown)) continue;
        const float candidate = length + (dx != 0 && dy != 0 ? diagonal : straight);
        if (candidate < lengths.at(next) && static_cast<double>(candidate) <= limit) {
          lengths.at(next) = candidate;
          open.push({candidate, next});
        }
      }
    }
  }
  return lengths;
}

}  // namespace sarn_navigation
