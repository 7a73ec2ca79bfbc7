// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace lattice_planner::testing {

/// Pieces of heap that this program has taken so far.
[[nodiscard]] std::size_t allocations();

}  // namespace lattice_planner::testing
