// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/plan_continuation.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

namespace sarn_move_base {
namespace {

using lattice_planner::PlanStatus;

/// An empty hall of 10 x 5 m, cells of 0.1 m.
class PlanContinuationTest : public testing::Test {
 protected:
  PlanContinuationTest() : continuation_(planner(), continuation()) {
    view_.geometry = {100, 50, 0.1, 0.0, 0.0};
    cells_.assign(view_.geometry.size(), 0);
    view_.static_costs = cells_.data();
  }
  static lattice_planner::PlannerParams planner() {
    lattice_planner::PlannerParams params;
    params.table_radius = 0.0;  // ready at once
    return params;
  }
  static ContinuationParams continuation() {
    ContinuationParams params;
    params.planning_timeout = 5.0;  // wall time, of a busy machine too
    params.release_delay = 5.0;
    return params;
  }
  void block(int x, int y) { cells_[view_.geometry.index({x, y})] = 254; }
  ContinuedPlan plan(const sarn::Pose2D& robot, double now, double tolerance = 0.0) {
    return continuation_.plan({robot, goal_, now, tolerance}, view_);
  }

  std::vector<std::uint8_t> cells_;
  sarn::TimedCostmapView view_;
  sarn::Pose2D goal_{8.5, 2.5, 0.0};
  PlanContinuation continuation_;
};

TEST_F(PlanContinuationTest, firstPlanStartsStandingWhenTheSearchIsDone) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  ASSERT_EQ(first.result.status, PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(first.result.trajectory.startTime(), 105.0);
  EXPECT_DOUBLE_EQ(first.result.trajectory.points.front().v, 0.0);
}

TEST_F(PlanContinuationTest, unchangedWorldKeepsThePlanThatIsDriven) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  const auto robot = first.result.trajectory.sample(107.0).pose();
  const auto second = plan(robot, 107.0);
  ASSERT_EQ(second.result.trajectory.points.size(), first.result.trajectory.points.size());
  EXPECT_DOUBLE_EQ(second.result.trajectory.endTime(), first.result.trajectory.endTime());
}

TEST_F(PlanContinuationTest, widerBodyGetsAnotherPlanAndWeightsSetLaterKeepIt) {
  for (int y = 0; y < 50; ++y) {  // a wall with a door of 0.7 m
    if (y < 22 || y > 28) block(50, y);
  }
  EXPECT_EQ(plan({1.0, 2.5, 0.0}, 100.0).result.status, PlanStatus::kComplete);
  continuation_.setFootprint(
      lattice_planner::makeFootprint({{0.3, 0.45}, {-0.3, 0.45}, {-0.3, -0.45}, {0.3, -0.45}}));
  EXPECT_NE(plan({1.0, 2.5, 0.0}, 100.5).result.status, PlanStatus::kComplete) << "0.9 m wide";
  continuation_.setWeights(planner());
  continuation_.waitUntilReady();
  EXPECT_NE(plan({1.0, 2.5, 0.0}, 101.0).result.status, PlanStatus::kComplete);
  continuation_.setFootprint({});
  EXPECT_EQ(plan({1.0, 2.5, 0.0}, 101.5).result.status, PlanStatus::kComplete) << "round again";
}

TEST_F(PlanContinuationTest, newGoalBranchesOffThePlanThatIsDriven) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  goal_ = {5.0, 4.0, 1.5};
  const auto robot = first.result.trajectory.sample(107.0).pose();
  const auto second = plan(robot, 107.0);
  ASSERT_EQ(second.result.status, PlanStatus::kComplete);
  const auto& joined = second.result.trajectory;
  EXPECT_LE(joined.startTime(), 107.0);
  for (double t = 107.0; t < 112.0; t += 0.25) {
    const auto a = first.result.trajectory.sample(t);
    const auto b = joined.sample(t);
    EXPECT_NEAR(a.x, b.x, 1e-9) << t;
    EXPECT_NEAR(a.v, b.v, 1e-9) << t;
  }
  EXPECT_NEAR(joined.points.back().x, 5.0, 0.2);
}

TEST_F(PlanContinuationTest, robotElsewhereStartsAnew) {
  (void)plan({1.0, 2.5, 0.0}, 100.0);
  const auto second = plan({1.0, 4.0, 0.0}, 107.0);
  ASSERT_EQ(second.result.status, PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(second.result.trajectory.startTime(), 112.0);
  EXPECT_DOUBLE_EQ(second.result.trajectory.points.front().y, 4.0);
}

TEST_F(PlanContinuationTest, wallAcrossTheWayMakesANewPlan) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  for (int y = 10; y < 50; ++y) block(60, y);
  const auto robot = first.result.trajectory.sample(106.0).pose();
  const auto second = plan(robot, 106.0);
  ASSERT_EQ(second.result.status, PlanStatus::kComplete);
  double lowest = 5.0;
  for (const auto& point : second.result.trajectory.points) lowest = std::min(lowest, point.y);
  EXPECT_LT(lowest, 1.0) << "goes round the wall";
}

TEST_F(PlanContinuationTest, wallRightAheadIsNotDrivenInto) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  const auto robot = first.result.trajectory.sample(107.0).pose();
  const int column = static_cast<int>((robot.x + 0.5) / 0.1);
  for (int y = 10; y < 50; ++y) block(column, y);
  const auto second = plan(robot, 107.0);
  ASSERT_EQ(second.result.status, PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(second.result.trajectory.points.front().v, 0.0)
      << "what would be driven meanwhile is blocked";
}

TEST_F(PlanContinuationTest, arrivingRobotIsLeftToArrive) {
  const auto first = plan({1.0, 2.5, 0.0}, 100.0);
  const double end = first.result.trajectory.endTime();
  for (const double now : {end - 4.9, end - 1.0, end + 1.0}) {
    const auto later = plan(first.result.trajectory.sample(now).pose(), now);
    EXPECT_DOUBLE_EQ(later.result.trajectory.endTime(), end) << now - end;
  }
}

TEST_F(PlanContinuationTest, occupiedGoalMovesWithinTheToleranceOnly) {
  for (int y = 22; y < 28; ++y) {
    for (int x = 82; x < 88; ++x) block(x, y);
  }
  EXPECT_EQ(plan({1.0, 2.5, 0.0}, 100.0).result.status, PlanStatus::kGoalOccupied);
  EXPECT_EQ(plan({1.0, 2.5, 0.0}, 100.0, 0.1).result.status, PlanStatus::kGoalOccupied);
  const auto moved = plan({1.0, 2.5, 0.0}, 100.0, 0.6);
  EXPECT_EQ(moved.result.status, PlanStatus::kComplete);
  EXPECT_LE((moved.goal.position() - goal_.position()).norm(), 0.6);
  EXPECT_GT((moved.goal.position() - goal_.position()).norm(), 0.2);
}

TEST(PlanContinuation, refusesAReleaseBeforeTheSearchEnds) {
  ContinuationParams params;
  params.release_delay = 0.1;
  EXPECT_THROW(PlanContinuation({}, params), std::invalid_argument);
}

}  // namespace
}  // namespace sarn_move_base
