// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "sarn_common/pose2d.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_navigation/navigator_params.h"
#include "sarn_navigation/yield_monitor.h"

namespace sarn_navigation {

/// Nearest place where the robot is out of everybody's way: reachable within yield_search_radius over the
/// static layer, away from the line the blocked person walks on, and free of social cost in every layer. The
/// robot faces the person's line there, so that it sees them pass. Nothing when there is no such place.
[[nodiscard]] std::optional<sarn::Pose2D> findYieldSpot(const sarn::Pose2D& robot,
                                                        const BlockedPerson& person,
                                                        const sarn::TimedCostmapView& view,
                                                        const NavigatorParams& params);

}  // namespace sarn_navigation
