// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/planning_health.h"

#include <gtest/gtest.h>

namespace sarn_navigation {
namespace {

NavigatorStatus status(NavigatorState state, unsigned misses = 0) {
  NavigatorStatus s;
  s.state = state;
  s.deadline_misses = misses;
  return s;
}

TEST(PlanningHealth, drivingAFreshPlanIsFine) {
  PlanningHealth health(2.5);
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving), 0.4, "").level, HealthLevel::kOk);
  EXPECT_EQ(health.judge(status(NavigatorState::kIdle), -1.0, "").level, HealthLevel::kOk);
}

TEST(PlanningHealth, stalePlanIsAWarning) {
  PlanningHealth health(2.5);
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving), 2.6, "").level, HealthLevel::kWarn);
}

TEST(PlanningHealth, onlyNewDeadlineMissesAreAWarning) {
  PlanningHealth health(2.5);
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving, 3), 0.4, "").level, HealthLevel::kWarn);
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving, 3), 0.4, "").level, HealthLevel::kOk);
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving, 0), 0.4, "").level, HealthLevel::kOk)
      << "a new goal";
  EXPECT_EQ(health.judge(status(NavigatorState::kDriving, 1), 0.4, "").level, HealthLevel::kWarn);
}

TEST(PlanningHealth, figuresAreThoseOfTheLastSearch) {
  NavigatorStatus driving = status(NavigatorState::kDriving, 2);
  driving.planning_time = 0.02;
  driving.expansions = 300;
  driving.bound = 1.1;
  const SearchFigures figures = figuresOf(driving, 0.4);
  EXPECT_EQ(figures.planning_time, 0.02);
  EXPECT_EQ(figures.expansions, 300U);
  EXPECT_EQ(figures.bound, 1.1);
  EXPECT_EQ(figures.deadline_misses, 2U);
  EXPECT_EQ(figures.plan_age, 0.4);
}

TEST(SearchHealth, saysNothingWhileAllIsWell) {
  SearchHealth health(2.5);
  SearchFigures figures;
  EXPECT_FALSE(health.judge(figures));
  figures.deadline_misses = 1;
  EXPECT_EQ(health.judge(figures)->level, HealthLevel::kWarn);
  EXPECT_FALSE(health.judge(figures)) << "no new miss";
  figures.plan_age = 2.6;
  EXPECT_EQ(health.judge(figures)->level, HealthLevel::kWarn);
}

TEST(PlanningHealth, missingInputIsAnErrorThatSaysWhat) {
  PlanningHealth health(2.5);
  const Health judged = health.judge(status(NavigatorState::kDriving), 0.4, "no tf");
  EXPECT_EQ(judged.level, HealthLevel::kError);
  EXPECT_EQ(judged.summary, "no tf");
}

TEST(PlanningHealth, goalGivenUpIsAnError) {
  PlanningHealth health(2.5);
  NavigatorStatus given_up = status(NavigatorState::kAborted);
  given_up.reason = "no path";
  EXPECT_EQ(health.judge(given_up, -1.0, "").level, HealthLevel::kError);
  EXPECT_NE(health.judge(given_up, -1.0, "").summary.find("no path"), std::string::npos);
}

}  // namespace
}  // namespace sarn_navigation
