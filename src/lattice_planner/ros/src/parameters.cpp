// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ros/parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace lattice_planner {

PlannerParams readPlannerParameters(const ros::NodeHandle& nh) {
  return sarn::readParameters<PlannerParams>(nh);
}

}  // namespace lattice_planner
