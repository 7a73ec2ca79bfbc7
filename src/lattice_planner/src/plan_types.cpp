// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/plan_types.h"

namespace lattice_planner {

const char* toString(PlanStatus status) {
  switch (status) {
    case PlanStatus::kComplete:
      return "complete";
    case PlanStatus::kGoalAnyPose:
      return "goal at any heading";
    case PlanStatus::kPartial:
      return "partial";
    case PlanStatus::kStartOccupied:
      return "start occupied";
    case PlanStatus::kGoalOccupied:
      return "goal occupied";
    case PlanStatus::kGoalOutsideMap:
      return "goal outside map";
    case PlanStatus::kStartOutsideMap:
      return "start outside map";
    case PlanStatus::kNoPath:
      return "no path";
    case PlanStatus::kInvalidRequest:
      return "invalid request";
    case PlanStatus::kGoalUnknown:
      return "goal in unknown space";
  }
  return "unknown";
}

}  // namespace lattice_planner
