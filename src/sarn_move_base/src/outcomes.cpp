// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/outcomes.h"

namespace sarn_move_base {

PlannerOutcome outcomeOf(lattice_planner::PlanStatus status) {
  using lattice_planner::PlanStatus;
  switch (status) {
    case PlanStatus::kStartOccupied:
      return PlannerOutcome::kBlockedStart;
    case PlanStatus::kGoalOccupied:
      return PlannerOutcome::kBlockedGoal;
    case PlanStatus::kGoalUnknown:
      return PlannerOutcome::kUnknownGoal;
    case PlanStatus::kStartOutsideMap:
    case PlanStatus::kGoalOutsideMap:
      return PlannerOutcome::kOutOfMap;
    case PlanStatus::kInvalidRequest:
      return PlannerOutcome::kInternalError;
    default:
      return PlannerOutcome::kNoPathFound;
  }
}

}  // namespace sarn_move_base
