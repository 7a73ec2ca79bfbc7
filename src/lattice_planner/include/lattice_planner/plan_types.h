// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include "sarn_common/timed_trajectory.h"

namespace lattice_planner {

enum class PlanStatus {
  kComplete,         // ends standing inside both goal tolerances
  kGoalAnyPose,      // ends standing within xy_goal_tolerance (plus the braking distance), at another heading
  kPartial,          // ends standing on the way, at the reached place closest to the goal
  kStartOccupied,    // the start cell is lethal in the static layer
  kGoalOccupied,     // the goal cell is forbidden in the static layer, or the footprint fits nowhere there
  kGoalOutsideMap,   //
  kStartOutsideMap,  //
  kNoPath,           // no motion brings the robot closer; the trajectory, if any, only brakes
  kInvalidRequest,   // a value is not finite, a costmap pointer is missing, a time limit is not positive
  kGoalUnknown,      // the goal cell holds no information, and allow_unknown is false
};

/// The status as text, for example "goal outside map".
[[nodiscard]] const char* toString(PlanStatus status);

/// True when the trajectory leads towards the goal and may be driven.
[[nodiscard]] inline bool isDrivable(PlanStatus status) {
  return status == PlanStatus::kComplete || status == PlanStatus::kGoalAnyPose ||
         status == PlanStatus::kPartial;
}

struct PlanRequest {
  sarn::TrajectoryPoint start;  // planning frame, absolute time; speeds may lie off the lattice
  sarn::Pose2D goal;            // planning frame
  double time_limit = 0.2;      // [s] wall time after which plan() returns what it has
  // Asked now and then during the search: true ends it as its time limit does. Empty: only the limit counts.
  std::function<bool()> stop = {};
};

struct PlanResult {
  PlanStatus status = PlanStatus::kInvalidRequest;
  sarn::TimedTrajectory trajectory;  // starts at the request's start; ends standing still; empty when none
  double cost = std::numeric_limits<double>::infinity();  // C of the trajectory
  double bound =
      std::numeric_limits<double>::infinity();  // cost <= bound * optimum on the lattice; kComplete only
  std::size_t expansions = 0;                   // states expanded
  std::size_t generated = 0;                    // successors looked at
  double search_time = 0.0;                     // [s] wall time of the whole call
  double first_plan_time = 0.0;  // [s] of it until the first plan to the goal was found; 0: none was
  bool timed_out = false;        // time, expansions or memory ran out before the bound was proved
};

}  // namespace lattice_planner
