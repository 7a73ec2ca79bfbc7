// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sarn_common/cost_values.h"
#include "sarn_common/grid.h"

namespace sarn {

/// What a time-dependent planner reads: one static layer and K time layers over the same grid. It owns
/// nothing; the costmap that made it must outlive it and must not change meanwhile.
struct TimedCostmapView {
  GridGeometry geometry;                       // in the planning frame
  const std::uint8_t* static_costs = nullptr;  // row-major, values of cost_values.h, already inflated
  std::vector<const std::uint8_t*>
      layers;  // layer i: people from first_layer_time + i * layer_duration on; may be empty
  double first_layer_time = 0.0;  // [s] same clock as the trajectory's t
  double layer_duration = 0.5;    // [s] > 0

  /// Layer for time t [s]; before the first the first, after the last the last. -1 when there are none.
  [[nodiscard]] int layerAt(double t) const {
    if (layers.empty()) return -1;
    const double i = std::floor((t - first_layer_time) / layer_duration);
    return static_cast<int>(std::clamp(i, 0.0, static_cast<double>(layers.size() - 1)));
  }
};

}  // namespace sarn
