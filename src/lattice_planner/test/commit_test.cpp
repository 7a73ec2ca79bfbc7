// SPDX-License-Identifier: BSD-3-Clause
// What is driven of a plan while the next is made, and how the two join.
#include <gtest/gtest.h>

#include "lattice_planner/commit.h"
#include "small_planner.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

TEST(Commit, keepsThePointsUpToTheFirstAtOrAfterTheRelease) {
  const World world = World::room(4.0, 2.0);
  const PlanResult first = planner().plan(request({0.5, 1.0, 0.0}, {3.5, 1.0, 0.0}), world.view());
  const sarn::TimedTrajectory committed = commit(first.trajectory, 0.6, 1.1);
  ASSERT_EQ(committed.points.size(), 4U);
  EXPECT_DOUBLE_EQ(committed.startTime(), 0.5);
  EXPECT_DOUBLE_EQ(committed.endTime(), 1.25);
  PlanRequest next = request({}, {3.5, 1.0, 0.0});
  next.start = committed.points.back();
  const PlanResult second = planner().plan(next, world.view());
  ASSERT_EQ(second.status, PlanStatus::kComplete);
  const sarn::TimedTrajectory joined = join(committed, second.trajectory);
  PlanRequest whole = next;
  whole.start = committed.points.front();
  EXPECT_TRUE(faults(joined, whole, planner().params(), world).empty());
  EXPECT_NEAR(joined.endTime(), first.trajectory.endTime(), 0.5)
      << "re-planning in a still world changes little";
}

TEST(Commit, standsAfterTheEndAndIsEmptyWhenThereIsNothing) {
  sarn::TimedTrajectory previous;
  EXPECT_TRUE(commit(previous, 1.0).empty());
  previous.points = {{0.0, 0.0, 0.0, 0.25, 0.0, 0.0}, {0.03, 0.0, 0.0, 0.0, 0.0, 0.25}};
  const sarn::TimedTrajectory committed = commit(previous, 1.0);
  ASSERT_EQ(committed.points.size(), 3U);
  EXPECT_DOUBLE_EQ(committed.points.back().t, 1.0);
  EXPECT_DOUBLE_EQ(committed.points.back().v, 0.0);
  EXPECT_TRUE(commit(previous, 5.0, 6.0).empty());
  sarn::TimedTrajectory elsewhere;
  elsewhere.points = {{1.0, 0.0, 0.0, 0.0, 0.0, 1.0}};
  EXPECT_THROW((void)join(committed, elsewhere), std::invalid_argument);
}

}  // namespace
}  // namespace lattice_planner::testing
