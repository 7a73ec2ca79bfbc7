// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lattice_planner/state_pool.h"
#include "sarn_common/angles.h"
#include "search_task.h"

namespace lattice_planner {

/// Which states are one to the search: those in one cell of place, heading, speeds and time.
class MergeKey {
 public:
  explicit MergeKey(const SearchTask& task) : task_(task) {}

  void reset() {
    const sarn::GridGeometry& g = task_.costmap.geometry;
    const double extent = std::max(g.width, g.height) * g.resolution;
    cell_ = std::max(task_.params.merge_resolution, extent / 65535.0);  // the key has 16 bits a side
  }

  /// Cell, heading, speeds, time and whether it still escapes, in one word.
  [[nodiscard]] std::uint64_t of(const SearchState& state) const {
    const sarn::GridGeometry& g = task_.costmap.geometry;
    const auto x = static_cast<std::uint64_t>((state.x - g.origin_x) / cell_) & 0xFFFFU;
    const auto y = static_cast<std::uint64_t>((state.y - g.origin_y) / cell_) & 0xFFFFU;
    // Bins are centred on the start's heading, which the lattice's headings are offset by.
    const double turns = (state.theta - task_.request.start.theta) / (2.0 * sarn::kPi);
    const int bins = task_.params.heading_bins;
    const long bin = std::lround((turns - std::floor(turns)) * bins) % bins;
    const auto merge = static_cast<std::uint32_t>(task_.params.time_merge_steps);
    const std::uint32_t time = (std::min(state.step, task_.time.mergeStep()) + merge - 1) / merge;
    return x | y << 16U | static_cast<std::uint64_t>(bin) << 32U |
           static_cast<std::uint64_t>(state.v) << 42U | static_cast<std::uint64_t>(state.omega) << 47U |
           static_cast<std::uint64_t>(time) << 52U | static_cast<std::uint64_t>(state.escaping) << 63U;
  }

 private:
  const SearchTask& task_;
  double cell_ = 0.05;  // [m] edge of a merge cell
};

}  // namespace lattice_planner
