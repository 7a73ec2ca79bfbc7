// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <vector>

#include "cell_costs.h"
#include "fine_costmap.h"
#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "lattice_planner/state_pool.h"
#include "sarn_common/angles.h"
#include "sarn_common/timed_costmap_view.h"
#include "time_axis.h"

namespace lattice_planner {

/// What every part of the search reads: the robot's lattice and costs, and the present request.
class SearchTask {
 public:
  explicit SearchTask(const PlannerParams& planner_params)
      : params(planner_params), lattice(planner_params), cell_costs(planner_params, lattice) {}
  SearchTask(const SearchTask&) = delete;  // the parts keep references
  SearchTask& operator=(const SearchTask&) = delete;

  /// The outcome of a request that needs no search because it is wrong, if it is.
  [[nodiscard]] std::optional<PlanStatus> refuse(const PlanRequest& wanted,
                                                 const sarn::TimedCostmapView& costs) const;
  /// Lays the request out; it must not be one to refuse.
  void reset(const PlanRequest& wanted, const sarn::TimedCostmapView& costs);

  [[nodiscard]] bool atGoalPosition(const SearchState& state) const {
    const double dx = state.x - request.goal.x;
    const double dy = state.y - request.goal.y;
    return dx * dx + dy * dy < params.xy_goal_tolerance * params.xy_goal_tolerance;
  }
  [[nodiscard]] bool isGoal(const SearchState& state) const {
    return state.v == lattice.standingV() && state.omega == lattice.standingOmega() &&
           atGoalPosition(state) &&
           std::abs(sarn::angleDifference(state.theta, request.goal.theta)) < params.yaw_goal_tolerance;
  }
  /// The start may have speeds off the lattice and has actions of its own.
  [[nodiscard]] const std::vector<MotionPrimitive>& actions(StateId id, const SearchState& state) const {
    return id == 0 ? start_actions : lattice.from(state.v, state.omega);
  }
  /// A place of the map in the goal's frame.
  [[nodiscard]] Eigen::Vector2d inGoalFrame(double x, double y) const {
    return goal_from_map_ * Eigen::Vector2d(x, y);
  }
  /// [s] of a state, on the request's clock.
  [[nodiscard]] double timeOf(const SearchState& state) const {
    return request.start.t + state.step * params.time_step;
  }

  const PlannerParams params;
  const MotionLattice lattice;
  const CellCosts cell_costs;
  // Of the present request.
  PlanRequest request;             // headings in (-pi, pi]
  sarn::TimedCostmapView costmap;  // with one layer more, see TimeAxis; cells cut, see FineCostmap
  TimeAxis time;
  std::vector<MotionPrimitive> start_actions;

 private:
  Eigen::Isometry2d goal_from_map_ = Eigen::Isometry2d::Identity();
  FineCostmap fine_costmap_;
};

}  // namespace lattice_planner
