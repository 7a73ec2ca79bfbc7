// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lattice_planner/lattice_planner.h"

namespace lattice_planner::testing {

/// The default parameters with a table that is built once a test, also under slow sanitizers.
inline PlannerParams defaults() {
  PlannerParams params;
  params.table_radius = 0.6;
  return params;
}

/// A planner of these, shared by the tests of a file.
inline LatticePlanner& planner() {
  static LatticePlanner shared(defaults());
  return shared;
}

}  // namespace lattice_planner::testing
