// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/orca_simulator.h"

#include <algorithm>
#include <numeric>

namespace kobuki_sim {

std::size_t OrcaSimulator::addAgent(const OrcaAgent& agent) {
  agents_.push_back(agent);
  return agents_.size() - 1;
}

const std::vector<Eigen::Vector2d>& OrcaSimulator::computeVelocities() {
  positions_.resize(agents_.size());
  indices_.resize(agents_.size());
  velocities_.resize(agents_.size());
  std::iota(indices_.begin(), indices_.end(), 0);
  for (std::size_t i = 0; i < agents_.size(); ++i) positions_[i] = agents_[i].disc.position;
  grid_.build(positions_, indices_);
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    const OrcaAgent& agent = agents_[i];
    findNeighbors(i);
    findWalls(agent);
    velocities_[i] = solver_.velocity(agent.disc, agent.preferred_velocity, agent.max_speed, agent.params,
                                      time_step_, neighbors_, near_walls_);
  }
  return velocities_;
}

void OrcaSimulator::step() {
  const std::vector<Eigen::Vector2d>& velocities = computeVelocities();
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    agents_[i].disc.velocity = velocities[i];
    agents_[i].disc.position += time_step_ * velocities[i];
  }
}

void OrcaSimulator::findNeighbors(std::size_t i) {
  const OrcaAgent& agent = agents_[i];
  grid_.nearest(agent.disc.position, static_cast<int>(i), agent.params.neighbor_dist,
                agent.params.max_neighbors, near_);
  neighbors_.clear();
  for (const Near& near : near_)
    neighbors_.push_back({agents_[static_cast<std::size_t>(near.index)].disc, 0.5});
}

void OrcaSimulator::findWalls(const OrcaAgent& agent) {
  near_walls_.clear();
  const double reach = agent.params.time_horizon_obst * agent.max_speed + agent.disc.radius;
  for (const WallEdge& wall : walls_) {
    if (wall.faces(agent.disc.position) && wall.squaredDistance(agent.disc.position) < reach * reach) {
      near_walls_.push_back(wall);
    }
  }
  std::sort(near_walls_.begin(), near_walls_.end(), [&](const WallEdge& a, const WallEdge& b) {
    return a.squaredDistance(agent.disc.position) < b.squaredDistance(agent.disc.position);
  });
}

}  // namespace kobuki_sim
