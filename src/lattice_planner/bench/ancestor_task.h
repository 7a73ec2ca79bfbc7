// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner::bench {

/// One task on the lattice and at the cost of the method's published implementation (Kollmitz et al. 2015),
/// the ancestor: what its search and a textbook's have in common. Of the planner it has the actions, nothing
/// else.
class AncestorTask {
 public:
  struct State {
    sarn::Pose2D pose;  // exact, in the map frame
    int v = 0;          // index of the forward speed
    int omega = 0;      // index of the angular speed
    int step = 0;       // time steps since the start
  };

  /// `params` is the ancestor's preset.
  explicit AncestorTask(const PlannerParams& params) : params_(params), lattice_(params) {}
  /// The request's start stands. The costmap is kept and must outlive the search.
  void reset(const PlanRequest& request, const sarn::TimedCostmapView& costmap);

  [[nodiscard]] const PlannerParams& params() const { return params_; }
  [[nodiscard]] State start() const;
  [[nodiscard]] const std::vector<MotionPrimitive>& actions(const State& state) const {
    return lattice_.from(state.v, state.omega);
  }
  [[nodiscard]] static State after(const State& from, const MotionPrimitive& action) {
    return {from.pose * action.samples.back(), action.v, action.omega, from.step + 1};
  }
  /// 200 + 80 * octile(first cell, last cell) + the dearer of static and social cost at nine points, both
  /// ends included; people where they are when the action begins. Nothing where it is forbidden.
  [[nodiscard]] std::optional<double> costOf(const State& from, const MotionPrimitive& action,
                                             const sarn::Pose2D& end) const;
  /// The same for a whole plan: nothing when it is not one of this lattice, or forbidden.
  [[nodiscard]] std::optional<double> costOf(const sarn::TimedTrajectory& plan) const;
  /// The state as a plan shows it.
  [[nodiscard]] sarn::TrajectoryPoint pointOf(const State& state) const;
  /// Standing within the tolerances of the goal.
  [[nodiscard]] bool isGoal(const State& state) const;
  /// The ancestor's heuristic: the static layer's least cost to the goal, over 8 neighbours at full speed,
  /// without people and turns; infinity: not reached. Of a pose on the map.
  [[nodiscard]] double wavefront(const State& state) const { return wavefront_[cellOf(state)]; }
  [[nodiscard]] std::size_t cellOf(const State& state) const {
    return costmap_.geometry.index(costmap_.geometry.cellAtUnbounded(state.pose.x, state.pose.y));
  }
  /// The last time layer's number; people stay where it shows them. 0: nobody.
  [[nodiscard]] int lastLayer() const { return std::max(0, static_cast<int>(costmap_.layers.size()) - 1); }

 private:
  void computeWavefront();
  [[nodiscard]] int costAt(std::size_t cell, int layer) const;

  PlannerParams params_;
  MotionLattice lattice_;
  PlanRequest request_;
  sarn::TimedCostmapView costmap_;
  std::vector<double> wavefront_;  // by cell
};

}  // namespace lattice_planner::bench
