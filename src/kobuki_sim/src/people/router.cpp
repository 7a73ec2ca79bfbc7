// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/router.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    std::vector<Disc> covered = discs;
    for (Disc& disc : covered) disc.radius += radius + 0.5 * comfort;
    if (!searchWay(a, b, {&clearance_, radius + comfort, &covered}, way)) continue;
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

bool Router::nearestOpenCell(const Vector2d& p, const RouteSearch& search, CellIndex& cell) const {
  const sarn::GridGeometry& grid = clearance_.geometry;
  const CellIndex middle = grid.cellAtUnbounded(p.x(), p.y());
  const int reach = static_cast<int>(std::ceil(kFarthestSnap / grid.resolution));
  double best = kFarthestSnap;
  bool found = false;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const CellIndex candidate{x, y};
      if (!search.isOpen(candidate)) continue;
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

bool Router::searchWay(const Vector2d& a, const Vector2d& b, const SearchSpace& space,
                       std::vector<Vector2d>& way) const {
  thread_local RouteSearch search;
  thread_local std::vector<CellIndex> cells;
  search.enter(space);
  CellIndex start;
  CellIndex goal;
  if (!nearestOpenCell(a, search, start) || !nearestOpenCell(b, search, goal)) return false;
  if (!search.find(start, goal, cells)) return false;
  way.assign(1, a);
  for (const CellIndex& cell : cells) way.push_back(clearance_.geometry.center(cell));
  way.push_back(b);
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
