// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/costmap_2d.h>

#include <cstdint>

#include "sarn_common/grid.h"

namespace sarn_move_base {

/// Where a costmap lies. Its mutex must be held.
[[nodiscard]] sarn::GridGeometry geometryOf(const costmap_2d::Costmap2D& costmap);

/// The costs, taken under the costmap's mutex; cost values are the same (sarn_common/cost_values.h).
void copyCosts(costmap_2d::Costmap2D& costmap, sarn::Grid<std::uint8_t>& costs);

}  // namespace sarn_move_base
