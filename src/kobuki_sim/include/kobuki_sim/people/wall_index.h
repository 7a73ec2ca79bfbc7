// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "kobuki_sim/people/wall_edge.h"
#include "kobuki_sim/static_map.h"
#include "sarn_common/grid.h"

namespace kobuki_sim {

/// Outlines of the occupied cells of a map, wall on the left, simplified so that no point of them is farther
/// than `tolerance` [m] from the cells' edges (Douglas and Peucker 1973).
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> wallOutlines(const StaticMap& map, double tolerance);

/// Finds the edges near a place.
class WallIndex {
 public:
  /// Keeps, for each square of the plane, the edges within `reach` [m].
  WallIndex(std::vector<WallEdge> edges, double reach);

  /// Edges that face `p` within `range` [m] (at most the reach), nearest first, at most `max_count`.
  void nearest(const Eigen::Vector2d& p, double range, std::size_t max_count,
               std::vector<WallEdge>& found) const;
  [[nodiscard]] const std::vector<WallEdge>& edges() const { return edges_; }

 private:
  std::vector<WallEdge> edges_;
  sarn::GridGeometry squares_;
  std::vector<std::uint32_t> begin_;     // first entry of each square; one more at the end
  std::vector<std::uint32_t> in_reach_;  // indices of edges, by square
};

}  // namespace kobuki_sim
