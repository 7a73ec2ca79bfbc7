// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_common/timed_trajectory.h"
#include "sarn_move_base/path_timing.h"

namespace sarn_move_base {

/// A pose of a plan as move_base hands it from the global to the local planner.
struct StampedPose {
  sarn::Pose2D pose;  // in the plan's frame
  double t = 0.0;     // [s] when the robot is there; 0: no time
};

/// A timed trajectory and the goal that it leads to, which a partial one does not reach.
struct TimedPlan {
  sarn::TimedTrajectory trajectory;
  sarn::Pose2D goal;
};

/// The trajectory's poses with their times, then the goal without a time: move_base's plans have no other
/// place for times, speeds and the goal of a partial plan.
[[nodiscard]] std::vector<StampedPose> encode(const TimedPlan& plan);

/// What encode() was given. The means of neighbouring speeds follow from the poses; as plans end standing,
/// the speeds themselves follow backwards from the end: v_i = 2 mean_i - v_(i+1). Where that leaves the
/// limits (a plan of somebody else's, whose speeds jump) a point's speeds are the mean of its neighbours'.
///
/// A plan whose poses carry no growing times (from a planner that knows no time) is driven from `now` on,
/// starting with the speed `measured`: see timePath(). Throws std::invalid_argument that names the pose at
/// fault when the plan is empty or a value is not finite.
[[nodiscard]] TimedPlan decode(const std::vector<StampedPose>& poses, const DriveLimits& limits,
                               const sarn::Twist2D& measured, double now);

}  // namespace sarn_move_base
