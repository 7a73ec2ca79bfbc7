// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/control/SpaceInformation.h>

#include "lattice_planner_ompl/ompl_algorithm.h"

namespace lattice_planner_ompl {

/// One of OMPL's planners with OMPL's defaults, but for SST's radii (0.3 m, 0.1 m) and KPIECE's cells on the
/// floor (0.25 m). The space is one of makeSpaceInformation().
[[nodiscard]] ompl::base::PlannerPtr makePlanner(OmplAlgorithm algorithm,
                                                 const ompl::control::SpaceInformationPtr& si);

}  // namespace lattice_planner_ompl
