// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/route_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace kobuki_sim {
namespace {

using sarn::CellIndex;

constexpr float kDiagonal = 1.41421356F;
// Weight of the heuristic: prefers, among equals, the cell nearer to the goal.
constexpr float kHaste = 1.01F;

float octile(const CellIndex& a, const CellIndex& b) {
  const int dx = std::abs(a.x - b.x);
  const int dy = std::abs(a.y - b.y);
  return static_cast<float>(std::max(dx, dy)) + (kDiagonal - 1.0F) * static_cast<float>(std::min(dx, dy));
}

}  // namespace

CellIndex RouteSearch::cellOf(std::uint32_t index) const {
  const int width = space_.clearance->geometry.width;
  return {static_cast<int>(index) % width, static_cast<int>(index) / width};
}

void RouteSearch::enter(const SearchSpace& space) {
  space_ = space;
  if (nodes_.size() < space.clearance->cells.size()) nodes_.resize(space.clearance->cells.size());
  ++entered_;
  for (const Disc& disc : *space.discs) cover(disc);
}

void RouteSearch::cover(const Disc& disc) {
  const sarn::GridGeometry& grid = space_.clearance->geometry;
  const CellIndex low = grid.cellAtUnbounded(disc.center.x() - disc.radius, disc.center.y() - disc.radius);
  const CellIndex high = grid.cellAtUnbounded(disc.center.x() + disc.radius, disc.center.y() + disc.radius);
  for (int y = std::max(0, low.y); y <= std::min(grid.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(grid.width - 1, high.x); ++x) {
      if ((grid.center({x, y}) - disc.center).norm() < disc.radius)
        nodes_[grid.index({x, y})].covered = entered_;
    }
  }
}

bool RouteSearch::isOpen(const CellIndex& cell) const {
  const sarn::GridGeometry& grid = space_.clearance->geometry;
  if (!grid.contains(cell)) return false;
  const std::size_t i = grid.index(cell);
  return space_.clearance->cells[i] >= space_.needed && nodes_[i].covered != entered_;
}

void RouteSearch::push(const Open& open) {
  heap_.push_back(open);
  std::push_heap(heap_.begin(), heap_.end(), [](const Open& a, const Open& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.index > b.index;
  });
}

RouteSearch::Open RouteSearch::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), [](const Open& a, const Open& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.index > b.index;
  });
  const Open open = heap_.back();
  heap_.pop_back();
  return open;
}

void RouteSearch::expand(std::uint32_t index, const CellIndex& goal) {
  const CellIndex cell = cellOf(index);
  const float cost = nodes_[index].cost;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const CellIndex next{cell.x + dx, cell.y + dy};
      if ((dx == 0 && dy == 0) || !isOpen(next)) continue;
      const bool diagonal = dx != 0 && dy != 0;
      if (diagonal && (!isOpen({cell.x + dx, cell.y}) || !isOpen({cell.x, cell.y + dy}))) continue;
      const float candidate = cost + (diagonal ? kDiagonal : 1.0F);
      const auto i = static_cast<std::uint32_t>(space_.clearance->geometry.index(next));
      if (nodes_[i].visit == search_ && nodes_[i].cost <= candidate) continue;
      nodes_[i].cost = candidate;
      nodes_[i].parent = index;
      nodes_[i].visit = search_;
      push({candidate + kHaste * octile(next, goal), i});
    }
  }
}

bool RouteSearch::find(const CellIndex& start, const CellIndex& goal, std::vector<CellIndex>& way) {
  const auto index = [&](const CellIndex& c) {
    return static_cast<std::uint32_t>(space_.clearance->geometry.index(c));
  };
  ++search_;
  heap_.clear();
  Node& first = nodes_[index(start)];
  first.cost = 0.0F;
  first.parent = index(start);
  first.visit = search_;
  push({kHaste * octile(start, goal), index(start)});
  while (!heap_.empty()) {
    const Open best = pop();
    if (best.index == index(goal)) break;
    const float present = nodes_[best.index].cost + kHaste * octile(cellOf(best.index), goal);
    if (best.estimate <= present + 1e-3F) expand(best.index, goal);
  }
  if (nodes_[index(goal)].visit != search_) return false;
  way.assign(1, goal);
  for (std::uint32_t i = index(goal); nodes_[i].parent != i; i = nodes_[i].parent) {
    way.push_back(cellOf(nodes_[i].parent));
  }
  std::reverse(way.begin(), way.end());
  return true;
}

}  // namespace kobuki_sim
