// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/costmap_2d.h>
#include <costmap_2d/costmap_2d_ros.h>

#include <cstdint>

#include "lattice_planner/footprint.h"
#include "sarn_common/grid.h"
#include "sarn_common/timed_costmap_view.h"

namespace sarn_move_base {

/// Where a costmap lies. Its mutex must be held.
[[nodiscard]] sarn::GridGeometry geometryOf(const costmap_2d::Costmap2D& costmap);

/// The costs, taken under the costmap's mutex; cost values are the same (sarn_common/cost_values.h).
void copyCosts(costmap_2d::Costmap2D& costmap, sarn::Grid<std::uint8_t>& costs);

/// The costs as they lie there, without people's layers. The costmap's mutex must be held while it is used.
[[nodiscard]] sarn::TimedCostmapView viewOf(const costmap_2d::Costmap2D& costmap);

/// The costmap's own (padded) footprint; round where it is a circle's polygon, which costmap_2d makes of
/// robot_radius: costs are inflated by that. Throws std::invalid_argument when it is no robot's outline.
[[nodiscard]] lattice_planner::Footprint footprintOf(const costmap_2d::Costmap2DROS& costmap);

}  // namespace sarn_move_base
