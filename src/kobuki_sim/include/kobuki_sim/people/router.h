// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kobuki_sim/static_map.h"
#include "sarn_common/grid.h"

namespace kobuki_sim {

/// Walkable ways around walls: A* (Hart, Nilsson and Raphael 1968) over a grid of the clearance to walls,
/// then pulled tight like a string wherever the body fits straight through. Answers depend on the question
/// only.
class Router {
 public:
  /// `map` is not owned. The grid covers the map and `points` [m], with a rim to walk around the outside.
  Router(const StaticMap& map, const std::vector<Eigen::Vector2d>& points);

  /// Writes a way for a body of `radius` [m] from a to b, both included; false, and `way` as it was, when
  /// there is none.
  [[nodiscard]] bool route(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius,
                           std::vector<Eigen::Vector2d>& way) const;

 private:
  [[nodiscard]] bool search(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double clearance,
                            std::vector<Eigen::Vector2d>& way) const;
  [[nodiscard]] bool nearestOpenCell(const Eigen::Vector2d& p, double clearance, sarn::CellIndex& cell) const;
  void pullTight(double radius, std::vector<Eigen::Vector2d>& way) const;

  const StaticMap* map_;
  sarn::Grid<float> clearance_;  // [m] from a cell's centre to the nearest wall
};

}  // namespace kobuki_sim
