// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

namespace social_costmap {

using Polygon = std::vector<Eigen::Vector2d>;  // [m] convex, counter-clockwise; two points: a segment

/// Convex hull, counter-clockwise, without collinear points (Andrew 1979); reorders `points`.
void convexHull(std::vector<Eigen::Vector2d>& points, Polygon& hull);

/// Distance [m] from a point to a convex polygon; 0 inside.
[[nodiscard]] double distanceTo(const Polygon& polygon, const Eigen::Vector2d& point);

/// Edges of the minimum spanning tree (Prim 1957) that are no longer than max_length [m]: who stands next to
/// whom.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> neighbourLinks(
    const std::vector<Eigen::Vector2d>& members, double max_length);

/// The convex pieces of the space that a group shares while its members move from `from` to `to` (same
/// order): the o-space (hull) of a circle of people who stand within link_distance [m] of each other all
/// around, and the line between neighbours of a queue.
[[nodiscard]] std::vector<Polygon> groupSpace(const std::vector<Eigen::Vector2d>& from,
                                              const std::vector<Eigen::Vector2d>& to, double link_distance);

}  // namespace social_costmap
