// SPDX-License-Identifier: BSD-3-Clause
// Planning again while driving: what is kept from the last search, and that it changes nothing.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "lattice_planner/distance_field.h"
#include "small_planner.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

// What is known of the static layer survives a re-plan, and no change of the layer is overlooked.
TEST(Replanning, fieldEqualsAFreshOneWhateverChangesOnTheWay) {
  World world = doorway();
  std::array<bool, 256> blocked{};
  std::array<float, 256> rate{};
  for (std::size_t cost = 0; cost < 256; ++cost) {
    blocked[cost] = cost >= 253;
    rate[cost] = 2.0F + 0.02F * static_cast<float>(cost);
  }
  DistanceFieldTask task;
  task.geometry = world.view().geometry;
  task.blocked = &blocked;
  task.rate = &rate;
  task.goal_x = 3.6;
  task.goal_y = 0.75;
  task.goal_radius = 0.15;
  DistanceField field;
  std::mt19937 random(5);
  std::size_t reused = 0;
  for (int step = 0; step < 30; ++step) {
    const auto column = static_cast<int>(random() % 60);  // not at the goal
    const auto row = static_cast<int>(random() % 30);
    if (step % 3 == 1) world.setStatic({column, row}, static_cast<std::uint8_t>(random() % 255));
    task.costs = world.view().static_costs;
    task.start_x = 0.3 + 0.1 * step;
    task.start_y = 0.75;
    field.reset(task);
    reused += field.reused();
    (void)field.at(task.geometry.cellAtUnbounded(task.start_x, task.start_y));
    DistanceField fresh;
    fresh.reset(task);
    if (step % 2 == 0) continue;  // what is asked of it differs from time to time
    for (int y = 0; y < task.geometry.height; ++y) {
      for (int x = 0; x < task.geometry.width; ++x) {
        const float expected = fresh.at({x, y});
        const float now = field.at({x, y});
        if (expected == now) continue;
        ASSERT_NEAR(now, expected, 1e-4F * expected) << step << ": " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(reused, 1000U);
}

// A planner that has planned before answers as a new one does, at every step of a drive among people.
TEST(Replanning, givesThePlanOfAFreshPlanner) {
  World world = doorway();
  world.addLayers(20, 0.5);
  world.walk(3.4, 0.4, -0.3, 0.05);
  LatticePlanner used(defaults());
  PlanRequest task = request({0.4, 0.75, 1.5}, {3.6, 0.75, 0.0});
  int steps = 0;
  for (; steps < 12; ++steps) {
    const PlanResult again = used.plan(task, world.view());
    ASSERT_EQ(again.status, PlanStatus::kComplete) << steps;
    if (steps % 4 == 3) {
      LatticePlanner fresh(defaults());
      const PlanResult first = fresh.plan(task, world.view());
      ASSERT_EQ(first.status, PlanStatus::kComplete) << steps;
      EXPECT_NEAR(again.cost, first.cost, 0.005 * first.cost) << steps;
    }
    const auto& points = again.trajectory.points;
    if (points.size() < 4) break;
    task.start = points[2];
  }
  EXPECT_GT(steps, 6);
}

}  // namespace
}  // namespace lattice_planner::testing
