// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_common/timed_trajectory.h"

namespace lattice_planner {

/// What the planner's cost function C = sum w_i c_i charges for driving `trajectory` from time `from` [s] to
/// its end, sampled every 0.1 s: to compare a plan being driven with a new one on the newest costs. Forbidden
/// cells are charged like cost 252. After the last time layer nobody is charged for.
[[nodiscard]] double trajectoryCost(const PlannerParams& params, const sarn::TimedTrajectory& trajectory,
                                    const sarn::TimedCostmapView& costmap, double from);

}  // namespace lattice_planner
