// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/planning_health.h"

#include <utility>

namespace sarn_navigation {

Health PlanningHealth::judge(const NavigatorStatus& status, double plan_age,
                             const std::string& input_problem) {
  const bool missed = status.deadline_misses > deadline_misses_;
  deadline_misses_ = status.deadline_misses;  // a new goal starts from 0
  if (!input_problem.empty()) return {HealthLevel::kError, input_problem};
  switch (status.state) {
    case NavigatorState::kIdle:
      return {HealthLevel::kOk, "no goal"};
    case NavigatorState::kSucceeded:
      return {HealthLevel::kOk, "goal reached"};
    case NavigatorState::kAborted:
      return {HealthLevel::kError, "goal given up: " + status.reason};
    case NavigatorState::kRecovering:
      return {HealthLevel::kWarn, "recovers: " + status.reason};
    default:
      break;
  }
  if (plan_age > allowed_age_) return {HealthLevel::kWarn, "drives an old plan"};
  if (missed) return {HealthLevel::kWarn, "searches reach their time limit"};
  return {HealthLevel::kOk, status.reason.empty() ? "plans" : status.reason};
}

}  // namespace sarn_navigation
