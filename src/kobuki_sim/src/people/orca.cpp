// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/orca.h"

#include <algorithm>
#include <cmath>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kCovered = 1e-5;  // [m/s]

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d leftOf(const Vector2d& d) { return {-d.y(), d.x()}; }

/// Shortest way out of a velocity obstacle: the change of the relative velocity [m/s] and the boundary's
/// normal there.
struct Exit {
  Vector2d change;
  Vector2d normal;
};

/// Out of the disc of velocities around `centre` that touch the neighbour after the time that scaled it.
Exit exitThroughCap(const Vector2d& relative_velocity, const Vector2d& centre, double cap_radius) {
  const Vector2d from_centre = relative_velocity - centre;
  const double distance = from_centre.norm();
  Vector2d normal = Vector2d::UnitX();
  if (distance > 0.0) {
    normal = from_centre / distance;
  } else if (centre.squaredNorm() > 0.0) {
    normal = -centre.normalized();
  }
  return {(cap_radius - distance) * normal, normal};
}

/// Out through the nearer of the two tangents from the origin to the disc of `radius` around `offset`.
Exit exitThroughLeg(const Vector2d& relative_velocity, const Vector2d& offset, double radius, bool left) {
  const double squared = offset.squaredNorm();
  const double leg = std::sqrt(std::max(0.0, squared - radius * radius));
  const double side = left ? 1.0 : -1.0;
  const Vector2d tangent = (leg * offset + side * radius * leftOf(offset)) / squared;
  const Vector2d normal = side * leftOf(tangent);
  return {-relative_velocity.dot(normal) * normal, normal};
}

Exit exitFromVelocityObstacle(const Vector2d& offset, const Vector2d& relative_velocity, double radius,
                              double time_horizon, double time_step) {
  if (offset.squaredNorm() <= radius * radius) {
    return exitThroughCap(relative_velocity, offset / time_step, radius / time_step);
  }
  const Vector2d cap_centre = offset / time_horizon;
  const Vector2d w = relative_velocity - cap_centre;
  const double along = w.dot(offset);
  const bool cap_is_nearest = along < 0.0 && along * along > radius * radius * w.squaredNorm();
  if (cap_is_nearest) return exitThroughCap(relative_velocity, cap_centre, radius / time_horizon);
  return exitThroughLeg(relative_velocity, offset, radius, cross(offset, w) > 0.0);
}

/// True when a plane already forbids all velocities that touch the edge at the time horizon.
bool isCovered(const WallEdge& wall, const Vector2d& position, double radius, double time_horizon,
               const std::vector<HalfPlane>& planes) {
  const Vector2d start = (wall.start.point - position) / time_horizon;
  const Vector2d end = (wall.end.point - position) / time_horizon;
  const double depth = radius / time_horizon - kCovered;
  return std::any_of(planes.begin(), planes.end(), [&](const HalfPlane& plane) {
    return plane.violation(start) >= depth && plane.violation(end) >= depth;
  });
}

}  // namespace

HalfPlane agentHalfPlane(const MovingDisc& agent, const OrcaNeighbor& neighbor, double time_horizon,
                         double time_step) {
  const Exit exit = exitFromVelocityObstacle(neighbor.disc.position - agent.position,
                                             agent.velocity - neighbor.disc.velocity,
                                             agent.radius + neighbor.disc.radius, time_horizon, time_step);
  return {agent.velocity + neighbor.responsibility * exit.change, exit.normal};
}

Vector2d OrcaSolver::velocity(const MovingDisc& agent, const Vector2d& preferred_velocity, double max_speed,
                              const OrcaParams& params, double time_step,
                              const std::vector<OrcaNeighbor>& neighbors,
                              const std::vector<WallEdge>& walls) {
  planes_.clear();
  for (const WallEdge& wall : walls) {
    if (isCovered(wall, agent.position, agent.radius, params.time_horizon_obst, planes_)) continue;
    const auto plane =
        wallHalfPlane(agent.position, agent.velocity, agent.radius, wall, params.time_horizon_obst);
    if (plane) planes_.push_back(*plane);
  }
  const std::size_t wall_count = planes_.size();
  for (const OrcaNeighbor& neighbor : neighbors) {
    planes_.push_back(agentHalfPlane(agent, neighbor, params.time_horizon, time_step));
  }
  return program_.nearestVelocity(planes_, wall_count, preferred_velocity, max_speed);
}

Vector2d orcaVelocity(const MovingDisc& agent, const Vector2d& preferred_velocity, double max_speed,
                      const OrcaParams& params, double time_step, const std::vector<OrcaNeighbor>& others,
                      const std::vector<WallEdge>& walls) {
  const auto squared_distance = [&](const OrcaNeighbor& n) {
    return (n.disc.position - agent.position).squaredNorm();
  };
  std::vector<OrcaNeighbor> neighbors;
  for (const OrcaNeighbor& other : others) {
    if (squared_distance(other) < params.neighbor_dist * params.neighbor_dist) neighbors.push_back(other);
  }
  std::stable_sort(neighbors.begin(), neighbors.end(),
                   [&](const auto& a, const auto& b) { return squared_distance(a) < squared_distance(b); });
  const auto limit = static_cast<std::size_t>(std::max(0, params.max_neighbors));
  if (neighbors.size() > limit) neighbors.resize(limit);

  const double reach = params.time_horizon_obst * max_speed + agent.radius;
  std::vector<WallEdge> facing;
  for (const WallEdge& wall : walls) {
    if (wall.faces(agent.position) && wall.squaredDistance(agent.position) < reach * reach)
      facing.push_back(wall);
  }
  std::stable_sort(facing.begin(), facing.end(), [&](const auto& a, const auto& b) {
    return a.squaredDistance(agent.position) < b.squaredDistance(agent.position);
  });
  OrcaSolver solver;
  return solver.velocity(agent, preferred_velocity, max_speed, params, time_step, neighbors, facing);
}

}  // namespace kobuki_sim
