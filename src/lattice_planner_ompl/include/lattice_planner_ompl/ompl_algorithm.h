// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lattice_planner_ompl {

/// OMPL's planners for motions with dynamics, as baselines on the lattice planner's problem: its limits, its
/// rule of what is forbidden, its cost.
enum class OmplAlgorithm {
  kSst,     // Li, Littlefield and Bekris, "Asymptotically optimal sampling-based kinodynamic planning", 2016
  kRrt,     // LaValle and Kuffner, "Randomized kinodynamic planning", 2001
  kKpiece,  // Sucan and Kavraki, "Kinodynamic motion planning by interior-exterior cell exploration", 2008
};
/// "sst", "rrt" or "kpiece"; throws std::invalid_argument otherwise.
[[nodiscard]] OmplAlgorithm algorithmOf(const std::string& name);

}  // namespace lattice_planner_ompl
