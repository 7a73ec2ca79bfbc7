// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kobuki_sim/people/half_plane.h"

namespace kobuki_sim {

/// A corner of a wall between two edges of its outline.
struct WallVertex {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();      // [m] map
  Eigen::Vector2d incoming = Eigen::Vector2d::UnitX();  // unit direction of the edge that ends here
  Eigen::Vector2d outgoing = Eigen::Vector2d::UnitX();  // unit direction of the edge that starts here
  bool convex = true;                                   // the wall's corner sticks out
};

/// One straight piece of an outline that runs with the wall on its left: people stand on its right.
struct WallEdge {
  WallVertex start;
  WallVertex end;

  [[nodiscard]] const Eigen::Vector2d& direction() const { return start.outgoing; }
  /// True when p is on the open side of the edge's line.
  [[nodiscard]] bool faces(const Eigen::Vector2d& p) const;
  /// Squared distance [m^2] from p to the edge.
  [[nodiscard]] double squaredDistance(const Eigen::Vector2d& p) const;
};

/// Edges of closed outlines, each counter-clockwise around its wall (so clockwise around a room). An outline
/// of two points is a thin wall with two faces. Throws std::invalid_argument for fewer points or for equal
/// neighbours.
[[nodiscard]] std::vector<WallEdge> wallEdges(const std::vector<std::vector<Eigen::Vector2d>>& outlines);

/// Velocities that keep a disc at `position` off `wall` for `time_horizon` [s] (section 5.4 of van den Berg
/// et al. 2011): the tangent of the edge's truncated velocity obstacle at the point nearest to the present
/// `velocity`; the disc takes the whole avoidance. Nothing when another edge of the outline has to say it.
[[nodiscard]] std::optional<HalfPlane> wallHalfPlane(const Eigen::Vector2d& position,
                                                     const Eigen::Vector2d& velocity, double radius,
                                                     const WallEdge& wall, double time_horizon);

}  // namespace kobuki_sim
