// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/pose2d.h"

namespace lattice_planner {

/// Obstacle-free cost to go near the goal, over the robot's pose in the goal's frame and its speeds: what
/// turning, braking and approaching the goal cost.
///
/// Value iteration V <- min_a c(a) + V(next), interpolated between the grid's nodes, from below: V starts at
/// a lower bound and rises to the fixed point. Costs come in whole actions, so that between nodes V can be
/// wrong by one: the lower bound at() takes one action's time off, the sharper guess() does not. The goal
/// region is widened to the nodes around it, so that V is zero in all of it.
class GoalTable {
 public:
  GoalTable(const PlannerParams& params, const MotionLattice& lattice);

  [[nodiscard]] bool empty() const { return radius_ <= 0.0; }
  /// True where at() interpolates: within the radius of the goal.
  [[nodiscard]] bool covers(double x, double y) const { return inside(x, y); }
  [[nodiscard]] double radius() const { return radius_; }  // [m]
  struct Value {
    float bound;  // not above the cost to go
    float guess;  // the likely cost to go
  };
  /// For the pose in the goal's frame and lattice speeds; outside the radius from turning, braking and
  /// distance alone.
  [[nodiscard]] Value at(double x, double y, double theta, int v, int omega) const;
  /// Smallest value over all headings and speeds of the nodes around a place in the goal's frame; 0 outside.
  [[nodiscard]] float floorAt(double x, double y) const;

 private:
  /// One action of one heading and speed pair: where it leads from any node.
  struct Transition {
    int dx;  // [nodes] lower left of the four nodes around the landing place
    int dy;
    float fx;  // [0, 1) landing place between them
    float fy;
    std::size_t heading_low;
    std::size_t heading_high;
    float heading_fraction;
    std::size_t speeds;
    int v;
    int omega;
    float cost;
  };

  [[nodiscard]] float margin() const { return static_cast<float>(time_weight_ * lattice_.timeStep()); }
  [[nodiscard]] bool inside(double x, double y) const;
  [[nodiscard]] float interpolate(std::size_t node, float fx, float fy, std::size_t low, std::size_t high,
                                  float fraction, std::size_t speeds) const;
  [[nodiscard]] float simpleBound(double x, double y, double turns, int v, int omega) const;
  [[nodiscard]] float interpolateAt(double x, double y, double turns, int v, int omega) const;
  void buildTurnCosts(double rotation_weight);
  void buildTransitions();
  void initialize();
  [[nodiscard]] float sweep(const std::vector<std::size_t>& order);
  [[nodiscard]] float bestSuccessor(int ix, int iy, const std::vector<Transition>& transitions) const;
  [[nodiscard]] bool isGoal(int ix, int iy, std::size_t heading, std::size_t speeds) const;
  [[nodiscard]] std::vector<std::size_t> nodesByDistance() const;
  void computeFloors();
  [[nodiscard]] std::size_t index(std::size_t node, std::size_t heading, std::size_t speeds) const {
    return (node * headings_ + heading) * speed_pairs_ + speeds;
  }

  const MotionLattice& lattice_;
  double radius_;
  double resolution_;
  double xy_tolerance_;   // [m] widened
  double yaw_tolerance_;  // [rad] widened
  double time_weight_;
  int half_;  // [nodes] from the centre to the edge
  int side_;  // [nodes]
  std::size_t headings_;
  std::size_t speed_pairs_;
  std::vector<std::vector<Transition>> transitions_;  // [heading * speed_pairs + speeds]
  std::vector<float> values_;                         // [node][heading][speeds]
  std::vector<float> floors_;                         // [node]
  std::vector<float> turn_costs_;  // [fine heading][omega]: turning and stopping, wherever it is
};

}  // namespace lattice_planner
