// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_common/timed_trajectory.h"

namespace sarn_move_base {

/// What a path is timed for.
struct DriveLimits {
  double max_vel_x = 0.5;      // [m/s] > 0
  double max_vel_theta = 1.0;  // [rad/s] > 0
  double acc_lim_x = 1.0;      // [m/s^2] > 0
  double acc_lim_theta = 2.0;  // [rad/s^2] > 0
};

/// Times for a path of mere poses, as a planner that knows no time makes it: turn in place towards it, drive
/// it, turn in place to the last heading. Corners of the simplified polyline are rounded by arcs tangent to
/// both sides; where the arc would be too tight to drive, the robot stops and turns. Speeds keep the limits,
/// found forwards and backwards along the path from `speed` [m/s] at its start and standstill at its end.
/// Headings of the poses between the ends are not looked at: the robot looks where it drives. Not empty.
[[nodiscard]] sarn::TimedTrajectory timePath(const std::vector<sarn::Pose2D>& path, const DriveLimits& limits,
                                             double speed, double start_time);

}  // namespace sarn_move_base
