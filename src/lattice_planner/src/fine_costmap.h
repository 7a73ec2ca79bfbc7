// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// A costmap of coarse cells, cut into finer ones: the same costs at every place. What guides the search is
/// computed cell by cell, and cells of a robot's size would lead it astray.
class FineCostmap {
 public:
  /// The view itself where its cells are small enough, else one with cells of at most `largest` [m], which is
  /// good until the next call.
  [[nodiscard]] sarn::TimedCostmapView of(const sarn::TimedCostmapView& costmap, double largest);

 private:
  std::vector<std::vector<std::uint8_t>> layers_;  // the static one, then people's
};

}  // namespace lattice_planner
