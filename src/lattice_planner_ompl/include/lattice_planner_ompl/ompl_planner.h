// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "lattice_planner_ompl/ompl_algorithm.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner_ompl {

struct OmplOutcome {
  lattice_planner::PlanResult result;
  double first_solution_time = 0.0;  // [s] wall time to the first exact solution; 0: none
};

/// Answers what LatticePlanner answers, by one of OMPL's planners. Not thread-safe. OMPL has one seed a
/// process, the first one given; how many numbers are drawn depends on the machine.
class OmplPlanner {
 public:
  OmplPlanner(OmplAlgorithm algorithm, const lattice_planner::PlannerParams& params, std::uint32_t seed = 1);

  /// As LatticePlanner::plan: the trajectory ends standing still; kPartial when the goal was not reached.
  [[nodiscard]] lattice_planner::PlanResult plan(const lattice_planner::PlanRequest& request,
                                                 const sarn::TimedCostmapView& costs);
  [[nodiscard]] OmplOutcome planMeasured(const lattice_planner::PlanRequest& request,
                                         const sarn::TimedCostmapView& costs);

 private:
  OmplAlgorithm algorithm_;
  lattice_planner::PlannerParams params_;
};

}  // namespace lattice_planner_ompl
