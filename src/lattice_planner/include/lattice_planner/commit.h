// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sarn_common/timed_trajectory.h"

namespace lattice_planner {

/// What the robot will still drive of `previous` while the next search runs: from the point that holds at
/// `now` to the first point at or after `release_time` [s], so that the new search starts on the lattice. The
/// last point is the start of the next PlanRequest. Empty when `previous` is empty or ends before `now`;
/// after the end of `previous` the robot stands: then one standing point at `release_time` is appended.
[[nodiscard]] sarn::TimedTrajectory commit(const sarn::TimedTrajectory& previous, double now,
                                           double release_time);

/// As above, from the first point on.
[[nodiscard]] sarn::TimedTrajectory commit(const sarn::TimedTrajectory& previous, double release_time);

/// `committed` followed by `planned`, which must start at committed's last point (throws
/// std::invalid_argument when it is elsewhere by more than 1e-3 m, rad or s).
[[nodiscard]] sarn::TimedTrajectory join(const sarn::TimedTrajectory& committed,
                                         const sarn::TimedTrajectory& planned);

}  // namespace lattice_planner
