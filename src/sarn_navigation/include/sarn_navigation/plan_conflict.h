// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "lattice_planner/footprint_check.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_common/timed_trajectory.h"

namespace sarn_navigation {

/// Where a plan meets a cost that forbids the robot's centre.
struct Conflict {
  sarn::TrajectoryPoint where;
  bool with_people = false;  // false: with the static, inflated layer
};

/// First forbidden state (cost >= 253, unknown excepted) of the trajectory within [from, to] [s], judged with
/// the people layer of the time at which the robot is there. A forbidden stretch that begins at `from` is
/// left out: the robot stands in it already (somebody walked up to it) and the plan is the way out.
/// `footprint`, for a robot that is not round: its outline is looked at, too; it was reset to this view.
[[nodiscard]] std::optional<Conflict> firstConflict(const sarn::TimedTrajectory& trajectory,
                                                    const sarn::TimedCostmapView& view, double from,
                                                    double to,
                                                    lattice_planner::FootprintCheck* footprint = nullptr);

}  // namespace sarn_navigation
