// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kobuki_sim/people/route_search.h"
#include "kobuki_sim/static_map.h"
#include "sarn_common/grid.h"

namespace kobuki_sim {

/// Walkable ways around walls and standing people: A* (Hart, Nilsson and Raphael 1968) over a grid of the
/// clearance to walls, then pulled tight like a string wherever the body fits straight through. Answers
/// depend on the question only.
class Router {
 public:
  /// `map` is not owned and may be empty. The grid covers the map and `points` [m], with a rim to walk around
  /// the outside. `standing` is walked around wherever there is a way to.
  Router(const StaticMap& map, const std::vector<Eigen::Vector2d>& points, std::vector<Disc> standing);

  /// Writes a way for a body of `radius` [m] from a to b, both included, around the standing people and
  /// around `more` or, where that cannot be, around walls only; false, and `way` as it was, when walls leave
  /// none.
  [[nodiscard]] bool route(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius,
                           const std::vector<Disc>& more, std::vector<Eigen::Vector2d>& way) const;

  /// Whether the body can walk straight from a to b.
  [[nodiscard]] bool sees(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius) const;

 private:
  [[nodiscard]] bool routeAround(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius,
                                 const std::vector<Disc>& discs, std::vector<Eigen::Vector2d>& way) const;
  [[nodiscard]] bool nearestOpenCell(const Eigen::Vector2d& p, const RouteSearch& search,
                                     sarn::CellIndex& cell) const;
  [[nodiscard]] bool searchWay(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const SearchSpace& space,
                               std::vector<Eigen::Vector2d>& way) const;
  [[nodiscard]] bool isStraight(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius,
                                const std::vector<Disc>& discs) const;
  void pullTight(double radius, const std::vector<Disc>& discs, std::vector<Eigen::Vector2d>& way) const;

  const StaticMap* map_;
  std::vector<Disc> standing_;
  sarn::Grid<float> clearance_;  // [m] from a cell's centre to the nearest wall
};

}  // namespace kobuki_sim
