// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "sarn_common/grid.h"
#include "sarn_common/pose2d.h"
#include "sarn_common/timed_costmap_view.h"

namespace sarn_navigation {

inline constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// Length [m] of the shortest 8-connected way from a point to each cell over static costs below 253, no
/// longer than `limit` [m]; kUnreachable elsewhere. Unknown cells are passable only when allow_unknown.
[[nodiscard]] sarn::Grid<float> pathLengths(const sarn::TimedCostmapView& view, const Eigen::Vector2d& from,
                                            double limit = 1e9, bool allow_unknown = false);

}  // namespace sarn_navigation
