// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/planning_health.h"

#include <utility>

namespace sarn_navigation {

std::optional<Health> SearchHealth::judge(const SearchFigures& figures) {
  const bool missed = figures.deadline_misses > deadline_misses_;
  deadline_misses_ = figures.deadline_misses;  // a new goal starts from 0
  if (figures.plan_age > allowed_age_) return Health{HealthLevel::kWarn, "drives an old plan"};
  if (missed) return Health{HealthLevel::kWarn, "searches reach their time limit"};
  return std::nullopt;
}

SearchFigures figuresOf(const NavigatorStatus& status, double plan_age) {
  return {status.planning_time, status.expansions, status.bound, status.deadline_misses, plan_age};
}

Health PlanningHealth::judge(const NavigatorStatus& status, double plan_age,
                             const std::string& input_problem) {
  std::optional<Health> searches = searches_.judge(figuresOf(status, plan_age));
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
  if (searches) return *std::move(searches);
  return {HealthLevel::kOk, status.reason.empty() ? "plans" : status.reason};
}

}  // namespace sarn_navigation
