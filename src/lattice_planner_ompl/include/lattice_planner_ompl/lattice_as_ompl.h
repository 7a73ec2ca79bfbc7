// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerData.h>

#include "lattice_planner/lattice_planner.h"
#include "lattice_planner_ompl/robot_space.h"

namespace lattice_planner_ompl {

/// The lattice planner as a planner of OMPL, so that OMPL's tools (its Benchmark) run it beside theirs. Needs
/// a problem made by makeSpaceInformation() with a BrakingGoal.
///
/// The search ends with OMPL's termination condition, or after the OMPL parameter `time_limit` [s], whichever
/// comes first. OMPL's Benchmark logs `first solution time` [s] for each run: when the first plan to the goal
/// was in hand, which the rest of the search improves on.
class LatticeAsOmpl : public ompl::base::Planner {
 public:
  LatticeAsOmpl(const ompl::base::SpaceInformationPtr& si, const Problem& problem);
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& condition) override;
  void getPlannerData(ompl::base::PlannerData& data) const override;
  void clear() override;
  /// [s] of the last solve() until its first plan to the goal; 0: there was none.
  [[nodiscard]] double firstSolutionTime() const { return first_solution_time_; }
  void setTimeLimit(double seconds) { time_limit_ = seconds; }
  [[nodiscard]] double timeLimit() const { return time_limit_; }

 private:
  const Problem& problem_;
  lattice_planner::LatticePlanner planner_;
  double time_limit_ = 60.0;          // [s]
  double first_solution_time_ = 0.0;  // [s]
};

}  // namespace lattice_planner_ompl
