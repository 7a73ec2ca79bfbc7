// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>

#include "lattice_planner/lattice_planner.h"
#include "lattice_planner_ompl/robot_space.h"

namespace lattice_planner_ompl {

/// The lattice planner as a planner of OMPL, so that OMPL's tools (its Benchmark) run it beside theirs. Needs
/// a problem made by makeSpaceInformation() with a BrakingGoal.
///
/// OMPL's termination condition cannot be asked how much time is left: the search's time limit is the OMPL
/// parameter `time_limit` [s].
class LatticeAsOmpl : public ompl::base::Planner {
 public:
  LatticeAsOmpl(const ompl::base::SpaceInformationPtr& si, const Problem& problem);
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& condition) override;
  void setTimeLimit(double seconds) { time_limit_ = seconds; }
  [[nodiscard]] double timeLimit() const { return time_limit_; }

 private:
  const Problem& problem_;
  lattice_planner::LatticePlanner planner_;
  double time_limit_ = 0.5;  // [s]
};

}  // namespace lattice_planner_ompl
