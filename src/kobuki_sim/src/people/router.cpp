// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/router.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "kobuki_sim/people/walking_space.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;
using sarn::CellIndex;

constexpr double kFinestCell = 0.1;  // [m]
constexpr double kRim = 1.5;         // [m] around map and points
constexpr std::size_t kMostCells = 4'000'000;
constexpr double kComfort = 0.1;       // [m] kept between body and wall where there is room
constexpr double kFarthestSnap = 0.6;  // [m] from a point to the nearest open cell
constexpr float kUnreached = std::numeric_limits<float>::infinity();

sarn::GridGeometry coverage(const StaticMap& map, const std::vector<Vector2d>& points) {
  const sarn::GridGeometry& g = map.geometry();
  Vector2d low(g.origin_x, g.origin_y);
  Vector2d high = low + g.resolution * Vector2d(g.width, g.height);
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  sarn::GridGeometry grid;
  grid.resolution = std::max(kFinestCell, g.resolution);
  grid.origin_x = low.x() - kRim;
  grid.origin_y = low.y() - kRim;
  const Vector2d cells = (high - low + Vector2d::Constant(2.0 * kRim)) / grid.resolution;
  if (!(cells.x() * cells.y() < static_cast<double>(kMostCells))) {
    throw std::invalid_argument("people: map and waypoints span " + std::to_string(high.x() - low.x()) +
                                " m x " + std::to_string(high.y() - low.y()) +
                                " m; that is too far to find ways in");
  }
  grid.width = static_cast<int>(std::ceil(cells.x()));
  grid.height = static_cast<int>(std::ceil(cells.y()));
  return grid;
}

/// Beyond this all clearances are as good.
constexpr double kFullClearance = 1.0;  // [m]

float clearanceAt(const StaticMap& map, const Vector2d& p) {
  const double bound = map.clearanceLowerBound(p);
  if (bound >= kFullClearance) return static_cast<float>(kFullClearance);
  const auto wall = map.nearestWall(p, kFullClearance);
  return static_cast<float>(wall ? wall->distance : kFullClearance);
}

double octile(const CellIndex& a, const CellIndex& b) {
  const int dx = std::abs(a.x - b.x);
  const int dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
}

struct Open {
  double estimate;
  std::uint32_t index;
  bool operator>(const Open& other) const {
    return estimate != other.estimate ? estimate > other.estimate : index > other.index;
  }
};

}  // namespace

Router::Router(const StaticMap& map, const std::vector<Vector2d>& points)
    : map_(&map), clearance_(coverage(map, points), 0.0F) {
  for (int y = 0; y < clearance_.geometry.height; ++y) {
    for (int x = 0; x < clearance_.geometry.width; ++x) {
      clearance_.at({x, y}) = clearanceAt(map, clearance_.geometry.center({x, y}));
    }
  }
}

bool Router::route(const Vector2d& a, const Vector2d& b, double radius, std::vector<Vector2d>& way) const {
  if (canWalkStraight(map_, a, b, radius)) {
    way = {a, b};
    return true;
  }
  for (const double comfort : {kComfort, 0.0}) {
    if (!search(a, b, radius + comfort, way)) continue;
    pullTight(radius + 0.5 * comfort, way);
    return true;
  }
  return false;
}

bool Router::nearestOpenCell(const Vector2d& p, double clearance, CellIndex& cell) const {
  const CellIndex middle = clearance_.geometry.cellAtUnbounded(p.x(), p.y());
  const int reach = static_cast<int>(std::ceil(kFarthestSnap / clearance_.geometry.resolution));
  double best = kFarthestSnap;
  bool found = false;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const CellIndex candidate{x, y};
      if (!clearance_.geometry.contains(candidate) || clearance_.at(candidate) < clearance) continue;
      const Vector2d center = clearance_.geometry.center(candidate);
      const double distance = (center - p).norm();
      if (distance >= best || !map_->segmentFree(p, center)) continue;
      best = distance;
      cell = candidate;
      found = true;
    }
  }
  return found;
}

bool Router::search(const Vector2d& a, const Vector2d& b, double clearance,
                    std::vector<Vector2d>& way) const {
  const sarn::GridGeometry& grid = clearance_.geometry;
  CellIndex start;
  CellIndex goal;
  if (!nearestOpenCell(a, clearance, start) || !nearestOpenCell(b, clearance, goal)) return false;
  std::vector<float> cost(grid.size(), kUnreached);
  std::vector<std::uint32_t> parent(grid.size());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto index = [&](const CellIndex& c) { return static_cast<std::uint32_t>(grid.index(c)); };
  const auto isOpen = [&](const CellIndex& c) { return grid.contains(c) && clearance_.at(c) >= clearance; };
  cost[index(start)] = 0.0F;
  parent[index(start)] = index(start);
  open.push({octile(start, goal), index(start)});
  while (!open.empty()) {
    const Open best = open.top();
    open.pop();
    const CellIndex cell{static_cast<int>(best.index) % grid.width,
                         static_cast<int>(best.index) / grid.width};
    if (cell == goal) break;
    if (best.estimate > cost[best.index] + octile(cell, goal) + 1e-3) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex next{cell.x + dx, cell.y + dy};
        if ((dx == 0 && dy == 0) || !isOpen(next)) continue;
        if (dx != 0 && dy != 0 && (!isOpen({cell.x + dx, cell.y}) || !isOpen({cell.x, cell.y + dy})))
          continue;
        const float step = dx != 0 && dy != 0 ? static_cast<float>(std::sqrt(2.0)) : 1.0F;
        const float candidate = cost[best.index] + step;
        if (candidate >= cost[index(next)]) continue;
        cost[index(next)] = candidate;
        parent[index(next)] = best.index;
        open.push({candidate + octile(next, goal), index(next)});
      }
    }
  }
  if (cost[index(goal)] == kUnreached) return false;
  way.assign(1, b);
  for (std::uint32_t i = index(goal);; i = parent[i]) {
    way.push_back(grid.center({static_cast<int>(i) % grid.width, static_cast<int>(i) / grid.width}));
    if (parent[i] == i) break;
  }
  way.push_back(a);
  std::reverse(way.begin(), way.end());
  return true;
}

/// Drops each point that the one before need not pass: gallops to a point out of sight, then halves.
void Router::pullTight(double radius, std::vector<Vector2d>& way) const {
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 1 < way.size();) {
    const auto sees = [&](std::size_t j) { return canWalkStraight(map_, way[i], way[j], radius); };
    std::size_t seen = i + 1;
    std::size_t stride = 1;
    for (; seen + stride < way.size() && sees(seen + stride); stride *= 2) seen += stride;
    for (; stride > 0; stride /= 2) {
      if (seen + stride < way.size() && sees(seen + stride)) seen += stride;
    }
    way[++kept] = way[seen];
    i = seen;
  }
  way.resize(kept + 1);
}

}  // namespace kobuki_sim
