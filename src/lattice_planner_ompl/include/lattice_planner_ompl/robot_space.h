// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/State.h>
#include <ompl/base/goals/GoalRegion.h>
#include <ompl/control/SpaceInformation.h>

#include <chrono>
#include <memory>
#include <optional>

#include "lattice_planner/footprint_check.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_common/timed_trajectory.h"

// The lattice planner's problem in OMPL's words: Sucan, Moll and Kavraki, "The Open Motion Planning Library",
// IEEE Robotics and Automation Magazine 2012.
namespace lattice_planner_ompl {

/// The problem's data. The costs must outlive it.
struct Problem {
  lattice_planner::PlannerParams params;
  sarn::TimedCostmapView costs;
  double longest = 60.0;                                                 // [s] no plan takes longer
  std::shared_ptr<lattice_planner::FootprintCheck> footprint = nullptr;  // of a robot that is not round
};

/// With what params.footprint asks for. Throws std::invalid_argument when that is no outline.
[[nodiscard]] Problem makeProblem(const lattice_planner::PlannerParams& params,
                                  const sarn::TimedCostmapView& costs);

/// The state space (x, y, theta) x (v, omega) x t as OMPL states.
[[nodiscard]] sarn::TrajectoryPoint pointOf(const ompl::base::State* state);
void setState(ompl::base::State* state, const sarn::TrajectoryPoint& point);

/// One step of motion: speeds change linearly, the pose follows the arc of their means, as in the lattice.
[[nodiscard]] sarn::TrajectoryPoint stepped(const sarn::TrajectoryPoint& from, double acceleration,
                                            double angular_acceleration, double dt);

/// Space, accelerations as controls, propagation in steps of the lattice's collision checks, and the
/// lattice's rule of what is forbidden: at each state the static layer and the people's layer of the state's
/// time. `start_time` [s]: times of states are bounded to start there.
[[nodiscard]] ompl::control::SpaceInformationPtr makeSpaceInformation(const Problem& problem,
                                                                      double start_time);

/// True when the robot may be there then, by the lattice's rules.
[[nodiscard]] bool isFree(const Problem& problem, const sarn::TrajectoryPoint& point);

/// C = sum w_i c_i, summed over the steps between two states that constant accelerations join.
class CostObjective : public ompl::base::OptimizationObjective {
 public:
  CostObjective(const ompl::base::SpaceInformationPtr& si, const Problem& problem);
  [[nodiscard]] ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  [[nodiscard]] ompl::base::Cost motionCost(const ompl::base::State* from,
                                            const ompl::base::State* to) const override;

 private:
  const Problem& problem_;
};

/// States from which braking at once ends inside the goal's tolerances: a random motion never stands exactly.
class BrakingGoal : public ompl::base::GoalRegion {
 public:
  BrakingGoal(const ompl::base::SpaceInformationPtr& si, const Problem& problem, const sarn::Pose2D& goal);
  [[nodiscard]] double distanceGoal(const ompl::base::State* state) const override;
  [[nodiscard]] const sarn::Pose2D& pose() const { return goal_; }
  /// When a planner first asked about a state of the goal: SST keeps its solutions to itself until its time
  /// is over.
  [[nodiscard]] const std::optional<std::chrono::steady_clock::time_point>& firstReached() const {
    return first_reached_;
  }

 private:
  [[nodiscard]] double distanceFrom(const sarn::TrajectoryPoint& point) const;

  const Problem& problem_;
  sarn::Pose2D goal_;
  mutable std::optional<std::chrono::steady_clock::time_point> first_reached_;
};

/// The motion from `from` to standstill, in steps, without `from`.
[[nodiscard]] std::vector<sarn::TrajectoryPoint> brake(const Problem& problem,
                                                       const sarn::TrajectoryPoint& from);
/// Duration [s] of a step of propagation: a whole part of the lattice's time step.
[[nodiscard]] double stepDuration(const lattice_planner::PlannerParams& params);

}  // namespace lattice_planner_ompl
