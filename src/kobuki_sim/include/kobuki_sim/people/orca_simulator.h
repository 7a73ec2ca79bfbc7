// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kobuki_sim/people/neighbor_grid.h"
#include "kobuki_sim/people/orca.h"
#include "kobuki_sim/people/wall_edge.h"

namespace kobuki_sim {

/// An agent with its own parameters.
struct OrcaAgent {
  MovingDisc disc;
  Eigen::Vector2d preferred_velocity = Eigen::Vector2d::Zero();  // [m/s]
  double max_speed = 1.0;                                        // [m/s]
  OrcaParams params;
};

/// Agents in one open world with walls that all decide from the same snapshot and then move for `time_step`:
/// the joint simulator that crowd-navigation training uses. Holonomic; it never limits motion by anything but
/// ORCA.
class OrcaSimulator {
 public:
  explicit OrcaSimulator(double time_step) : time_step_(time_step) {}

  /// Index of the new agent.
  std::size_t addAgent(const OrcaAgent& agent);
  [[nodiscard]] std::vector<OrcaAgent>& agents() { return agents_; }
  [[nodiscard]] const std::vector<OrcaAgent>& agents() const { return agents_; }
  void clearAgents() { agents_.clear(); }
  /// Walls as wallEdges() takes them.
  void setOutlines(const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
    walls_ = wallEdges(outlines);
  }
  [[nodiscard]] double timeStep() const { return time_step_; }  // [s]

  /// New velocities [m/s] of all agents, which do not move yet.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& computeVelocities();
  /// computeVelocities(), then everyone takes the new velocity and moves with it for one time step.
  void step();

 private:
  void findNeighbors(std::size_t i);
  void findWalls(const OrcaAgent& agent);

  double time_step_;  // [s]
  std::vector<OrcaAgent> agents_;
  std::vector<WallEdge> walls_;
  std::vector<Eigen::Vector2d> velocities_;
  // Working memory.
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> indices_;
  NeighborGrid grid_;
  std::vector<Near> near_;
  std::vector<OrcaNeighbor> neighbors_;
  std::vector<WallEdge> near_walls_;
  OrcaSolver solver_;
};

}  // namespace kobuki_sim
