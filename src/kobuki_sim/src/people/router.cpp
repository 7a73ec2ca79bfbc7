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
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  const auto include = [&](const Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  sarn::GridGeometry grid;
  grid.resolution = kFinestCell;
  if (!map.empty()) {
    const sarn::GridGeometry& g = map.geometry();
    include({g.origin_x, g.origin_y});
    include({g.origin_x + g.resolution * g.width, g.origin_y + g.resolution * g.height});
    grid.resolution = std::max(kFinestCell, g.resolution);
  }
  for (const Vector2d& p : points) include(p);
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

Router::Router(const StaticMap& map, const std::vector<Vector2d>& points, std::vector<Disc> standing)
    : map_(&map), standing_(std::move(standing)), clearance_(coverage(map, points), 0.0F) {
  for (int y = 0; y < clearance_.geometry.height; ++y) {
    for (int x = 0; x < clearance_.geometry.width; ++x) {
      clearance_.at({x, y}) = clearanceAt(map, clearance_.geometry.center({x, y}));
    }
  }
}

bool Router::route(const Vector2d& a, const Vector2d& b, double radius, const std::vector<Disc>& more,
                   std::vector<Vector2d>& way) const {
  if (!more.empty()) {
    std::vector<Disc> all = standing_;
    all.insert(all.end(), more.begin(), more.end());
    if (routeAround(a, b, radius, all, way)) return true;
  }
  return routeAround(a, b, radius, standing_, way) || routeAround(a, b, radius, {}, way);
}

bool Router::sees(const Vector2d& a, const Vector2d& b, double radius) const {
  return isStraight(a, b, radius, standing_);
}

bool Router::routeAround(const Vector2d& a, const Vector2d& b, double radius, const std::vector<Disc>& discs,
                         std::vector<Vector2d>& way) const {
  if (isStraight(a, b, radius, discs)) {
    way = {a, b};
    return true;
  }
  for (const double comfort : {kComfort, 0.0}) {
    if (!search(a, b, openCells(radius, comfort, discs), way)) continue;
    pullTight(radius + 0.5 * comfort, discs, way);
    return true;
  }
  return false;
}

bool Router::isStraight(const Vector2d& a, const Vector2d& b, double radius,
                        const std::vector<Disc>& discs) const {
  const Vector2d way = b - a;
  const double squared = way.squaredNorm();
  for (const Disc& disc : discs) {
    const double t = squared > 0.0 ? std::clamp((disc.center - a).dot(way) / squared, 0.0, 1.0) : 0.0;
    const double reach = disc.radius + radius;
    // Walking away from somebody whom the body is already near is free.
    if (t > 0.0 && (a + t * way - disc.center).squaredNorm() < reach * reach) return false;
  }
  return canWalkStraight(map_, a, b, radius);
}

std::vector<char> Router::openCells(double body, double comfort, const std::vector<Disc>& discs) const {
  const sarn::GridGeometry& grid = clearance_.geometry;
  std::vector<char> open(grid.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = clearance_.cells[i] >= body + comfort ? 1 : 0;
  for (const Disc& disc : discs) {
    const double reach = disc.radius + body + 0.5 * comfort;
    const CellIndex low = grid.cellAtUnbounded(disc.center.x() - reach, disc.center.y() - reach);
    const CellIndex high = grid.cellAtUnbounded(disc.center.x() + reach, disc.center.y() + reach);
    for (int y = std::max(0, low.y); y <= std::min(grid.height - 1, high.y); ++y) {
      for (int x = std::max(0, low.x); x <= std::min(grid.width - 1, high.x); ++x) {
        if ((grid.center({x, y}) - disc.center).norm() < reach) open[grid.index({x, y})] = 0;
      }
    }
  }
  return open;
}

bool Router::nearestOpenCell(const Vector2d& p, const std::vector<char>& open, CellIndex& cell) const {
  const sarn::GridGeometry& grid = clearance_.geometry;
  const CellIndex middle = grid.cellAtUnbounded(p.x(), p.y());
  const int reach = static_cast<int>(std::ceil(kFarthestSnap / grid.resolution));
  double best = kFarthestSnap;
  bool found = false;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const CellIndex candidate{x, y};
      if (!grid.contains(candidate) || open[grid.index(candidate)] == 0) continue;
      const Vector2d center = grid.center(candidate);
      const double distance = (center - p).norm();
      if (distance >= best || !map_->segmentFree(p, center)) continue;
      best = distance;
      cell = candidate;
      found = true;
    }
  }
  return found;
}

bool Router::search(const Vector2d& a, const Vector2d& b, const std::vector<char>& open_cells,
                    std::vector<Vector2d>& way) const {
  const sarn::GridGeometry& grid = clearance_.geometry;
  CellIndex start;
  CellIndex goal;
  if (!nearestOpenCell(a, open_cells, start) || !nearestOpenCell(b, open_cells, goal)) return false;
  std::vector<float> cost(grid.size(), kUnreached);
  std::vector<std::uint32_t> parent(grid.size());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto index = [&](const CellIndex& c) { return static_cast<std::uint32_t>(grid.index(c)); };
  const auto isOpen = [&](const CellIndex& c) { return grid.contains(c) && open_cells[grid.index(c)] != 0; };
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
void Router::pullTight(double radius, const std::vector<Disc>& discs, std::vector<Vector2d>& way) const {
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 1 < way.size();) {
    const auto sees = [&](std::size_t j) { return isStraight(way[i], way[j], radius, discs); };
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
