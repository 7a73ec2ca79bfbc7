// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/planner_params.h"

namespace lattice_planner {

/// What a cell's cost (0..255) means to the search: whether it forbids, and what staying there costs.
struct CellCosts {
  CellCosts(const PlannerParams& params, const MotionLattice& lattice);

  std::array<bool, 256> forbidden_static{};
  std::array<bool, 256> forbidden_social{};
  std::array<float, 256> static_cost{};       // of one sample's time in a cell
  std::array<float, 256> social_cost{};       // likewise
  std::array<float, 256> static_rate{};       // [1/s]
  std::array<float, 256> social_rate{};       // [1/s]
  std::array<float, 256> static_per_metre{};  // least cost of one metre in a cell
};

}  // namespace lattice_planner
