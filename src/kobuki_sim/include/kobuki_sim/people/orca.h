// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kobuki_sim/people/half_plane.h"
#include "kobuki_sim/people/wall_edge.h"

namespace kobuki_sim {

/// A moving disc, in the frame of the world (map).
struct MovingDisc {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double radius = 0.25;                                // [m] > 0
};

/// What one agent knows of collision avoidance.
struct OrcaParams {
  double neighbor_dist = 10.0;     // [m] agents whose centres are farther are not seen
  int max_neighbors = 10;          // only the nearest so many are avoided
  double time_horizon = 5.0;       // [s] > 0, collisions with agents this far ahead are avoided
  double time_horizon_obst = 5.0;  // [s] > 0, the same for walls
};

/// Somebody to avoid.
struct OrcaNeighbor {
  MovingDisc disc;
  double responsibility =
      0.5;  // share of the avoidance that the agent takes: 0.5 reciprocal, 1 it does not react
};

/// Velocities that keep `agent` clear of `neighbor` for `time_horizon` [s] if the neighbour does its share:
/// equations 5 and 6 of van den Berg et al. (2011), with their truncated velocity obstacle (equation 2).
/// Discs that overlap already separate within `time_step` [s].
[[nodiscard]] HalfPlane agentHalfPlane(const MovingDisc& agent, const OrcaNeighbor& neighbor,
                                       double time_horizon, double time_step);

/// ORCA (van den Berg, Guy, Lin, Manocha 2011) of one agent at a time. Keeps its working memory: one per
/// thread.
class OrcaSolver {
 public:
  /// New velocity [m/s]. `neighbors` are all avoided: pass those within neighbor_dist, at most max_neighbors.
  /// `walls`, nearest first, see WallEdge; edges that turn their back to the agent must be left out.
  [[nodiscard]] Eigen::Vector2d velocity(const MovingDisc& agent, const Eigen::Vector2d& preferred_velocity,
                                         double max_speed, const OrcaParams& params, double time_step,
                                         const std::vector<OrcaNeighbor>& neighbors,
                                         const std::vector<WallEdge>& walls);

 private:
  std::vector<HalfPlane> planes_;
  HalfPlaneProgram program_;
};

/// One answer without a solver at hand: selects the neighbours (nearest max_neighbors within neighbor_dist)
/// and the walls (in reach, facing the agent) itself. Arguments as OrcaSolver::velocity, in any order.
[[nodiscard]] Eigen::Vector2d orcaVelocity(const MovingDisc& agent, const Eigen::Vector2d& preferred_velocity,
                                           double max_speed, const OrcaParams& params, double time_step,
                                           const std::vector<OrcaNeighbor>& others,
                                           const std::vector<WallEdge>& walls = {});

}  // namespace kobuki_sim
