// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lattice_planner/PlannerConfig.h>
#include <ros/node_handle.h>

#include "lattice_planner/planner_params.h"

namespace lattice_planner {

/// Reads PlannerParams from nh's namespace; throws sarn::ParameterError that names every problem.
[[nodiscard]] PlannerParams readPlannerParameters(const ros::NodeHandle& nh);

/// What dynamic_reconfigure may change live; the other fields come from `base`.
[[nodiscard]] PlannerParams fromConfig(const PlannerConfig& config, PlannerParams base);
[[nodiscard]] PlannerConfig toConfig(const PlannerParams& params);

}  // namespace lattice_planner
