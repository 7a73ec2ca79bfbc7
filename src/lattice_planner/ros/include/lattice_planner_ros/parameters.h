// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include "lattice_planner/planner_params.h"

namespace lattice_planner {

/// Reads PlannerParams from nh's namespace and logs each value; throws sarn::ParameterError with every
/// problem at once.
[[nodiscard]] PlannerParams readPlannerParameters(const ros::NodeHandle& nh);

}  // namespace lattice_planner
