// SPDX-License-Identifier: BSD-3-Clause
// The planner among people: waiting, timing, where predictions end, and ways out from too near.
#include <gtest/gtest.h>

#include "small_planner.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

TEST(People, areWaitedForWhereThereIsNoWayAround) {
  // A corridor 0.4 m wide with a crossing that a person walks through for 3 s.
  World world({"####....####", "####....####", "............", "............", "............", "............",
               "####....####", "####....####"},
              0.1);
  world.addLayers(12, 0.5);
  for (int i = 0; i < 8; ++i) world.paint(i, 0.6, 0.4, 0.35);
  const PlanRequest task = request({0.15, 0.4, 0.0}, {1.05, 0.4, 0.0});
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_GT(result.trajectory.endTime(), 4.0);
  EXPECT_LT(result.trajectory.sample(3.9).x, 0.3) << "waits in front of the crossing";
  EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world).empty());
}

TEST(People, areAvoidedAtTheTimeTheRobotIsThere) {
  World world = World::room(4.0, 3.0);
  world.addLayers(20, 0.5);
  world.walk(2.0, 3.0, 0.0, -0.5);
  const PlanRequest task = request({0.4, 1.5, 0.0}, {3.6, 1.5, 0.0});
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world).empty());
}

TEST(People, costByTheSecondWhateverTheSamplingAndTheResolution) {
  double last = -1.0;
  for (const double resolution : {0.05, 0.1}) {
    for (const double check : {0.04, 0.01}) {
      PlannerParams params = defaults();
      params.collision_check_distance = check;
      params.table_radius = 0.0;
      params.improvement_effort = 0.0;  // the optimum, which is the same for all
      params.hurry_after = 0;
      LatticePlanner planner(params);
      World world = World::room(3.0, 1.0, resolution);
      world.addLayers(1, 0.5);
      world.paint(0, 1.5, 0.5, 5.0, 126);  // half cost everywhere
      const PlanResult result = planner.plan(request({0.5, 0.5, 0.0}, {2.5, 0.5, 0.0}), world.view());
      ASSERT_EQ(result.status, PlanStatus::kComplete);
      const double duration = result.trajectory.endTime() - result.trajectory.startTime();
      const double social = params.social_weight * 0.5 * duration;
      double rotation = 0.0;
      const auto& p = result.trajectory.points;
      for (std::size_t i = 1; i < p.size(); ++i)
        rotation += std::abs(0.5 * (p[i - 1].omega + p[i].omega)) * 0.25;
      EXPECT_NEAR(result.cost,
                  duration + social + params.length_weight * result.trajectory.length() +
                      params.rotation_weight * rotation,
                  1e-3);
      if (last >= 0.0) {
        EXPECT_NEAR(result.cost, last, 1e-3 * last);
      }
      last = result.cost;
    }
  }
}

TEST(People, whoWalkAreForgottenWhereThePredictionEnds) {
  World world = World::room(6.0, 0.8);
  world.addLayers(4, 0.5);
  world.walk(2.0, 0.4, 1.0, 0.0, 0.6);  // ends at x = 4, filling the corridor
  const PlanRequest task = request({0.4, 0.4, 0.0}, {5.6, 0.4, 0.0});
  EXPECT_EQ(planner().plan(task, world.view()).status, PlanStatus::kComplete);
  PlannerParams params = defaults();
  params.forget_moving_people = false;
  params.max_expansions = 20000;
  LatticePlanner careful(params);
  EXPECT_NE(careful.plan(task, world.view()).status, PlanStatus::kComplete);
}

TEST(People, whoStandRemainWhereThePredictionEnds) {
  World world = World::room(6.0, 0.8);
  world.addLayers(4, 0.5);
  world.walk(4.0, 0.4, 0.0, 0.0, 0.6);
  PlannerParams params = defaults();
  params.max_expansions = 20000;
  LatticePlanner careful(params);
  const PlanRequest task = request({0.4, 0.4, 0.0}, {5.6, 0.4, 0.0});
  const PlanResult result = careful.plan(task, world.view());
  EXPECT_EQ(result.status, PlanStatus::kPartial);
  EXPECT_LT(result.trajectory.points.back().x, 3.5);
  EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
}

// A row of people across the way, open at one end, costs the search no more than a wall of that shape.
TEST(People, whoStandGuideTheSearchAsWallsDo) {
  const auto work = [](bool people) {
    World world = World::room(6.0, 4.0);
    world.addLayers(20, 0.5);
    for (double y = 0.0; y < 3.2; y += 0.4) {
      for (int layer = 0; people && layer < 20; ++layer) world.paint(layer, 3.0, y, 0.35);
      if (!people) world.paintStatic(3.0, y, 0.35, sarn::kInscribedObstacle);
    }
    const PlanRequest task = request({1.0, 0.8, 0.0}, {5.0, 0.8, 0.0});
    const PlanResult result = planner().plan(task, world.view());
    EXPECT_EQ(result.status, PlanStatus::kComplete) << people;
    EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world).empty()) << people;
    return result;
  };
  const PlanResult walls = work(false);
  const PlanResult people = work(true);
  EXPECT_LT(people.expansions, walls.expansions + walls.expansions / 2);
  EXPECT_NEAR(people.cost, walls.cost, 0.02 * walls.cost);
}

TEST(Partial, standsWhereNobodyComes) {
  // The goal is occupied by a person all the time; another one sweeps the last metre before it later on.
  World world = World::room(5.0, 1.0);
  world.addLayers(20, 0.5);
  for (int i = 0; i < 20; ++i) world.paint(i, 4.5, 0.5, 0.6);
  for (int i = 10; i < 20; ++i) world.paint(i, 3.2, 0.5, 0.7);
  PlannerParams params = defaults();
  params.forget_moving_people = false;
  params.max_expansions = 20000;
  LatticePlanner careful(params);
  const PlanRequest task = request({0.4, 0.5, 0.0}, {4.5, 0.5, 0.0});
  const PlanResult result = careful.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kPartial);
  const sarn::TrajectoryPoint& end = result.trajectory.points.back();
  EXPECT_GT(end.x, 1.0) << "goes on as far as it can";
  for (double t = end.t; t < 10.0; t += 0.25) EXPECT_LT(world.costAt(end.x, end.y, t), 253) << t;
  EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
}

TEST(Escape, leavesInscribedCostButNeverTouchesLethal) {
  World world = World::room(3.0, 2.0);
  world.paintStatic(0.6, 1.0, 0.35, sarn::kInscribedObstacle);
  world.paintStatic(0.6, 1.0, 0.12, sarn::kLethalObstacle);
  const PlanRequest task = request({0.8, 1.0, sarn::kPi}, {2.5, 1.0, 0.0});
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  for (double t = 0.0; t < result.trajectory.endTime(); t += 0.05) {
    const auto p = result.trajectory.sample(t);
    EXPECT_LT(world.costAt(p.x, p.y, t), 254);
  }
  EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world, 6.0).empty())
      << "in again after it was out";
}

TEST(Escape, getsAwayFromAPersonWhoCameTooNear) {
  World world = World::room(3.0, 2.0);
  world.addLayers(10, 0.5);
  for (int i = 0; i < 10; ++i) world.paint(i, 1.2, 1.0, 0.4);
  const PlanRequest task = request({1.0, 1.0, sarn::kPi}, {0.3, 1.0, sarn::kPi});
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  double nearest = 1e9;
  for (double t = 0.0; t < result.trajectory.endTime(); t += 0.05) {
    const auto p = result.trajectory.sample(t);
    nearest = std::min(nearest, std::hypot(p.x - 1.2, p.y - 1.0));
  }
  EXPECT_GT(nearest, 0.19) << "never closer than it was";
}

TEST(Escape, doesNotLeadThroughThePersonToTheGoal) {
  World world = World::room(3.0, 2.0);
  world.addLayers(10, 0.5);
  for (int i = 0; i < 10; ++i) world.paint(i, 1.2, 1.0, 0.4);
  const PlanRequest task = request({1.0, 1.0, 0.0}, {2.5, 1.0, 0.0});
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  for (double t = 0.0; t < result.trajectory.endTime(); t += 0.05) {
    const auto p = result.trajectory.sample(t);
    EXPECT_GT(std::hypot(p.x - 1.2, p.y - 1.0), 0.19 - 0.05) << "deeper in than it was, at t = " << t;
  }
}

}  // namespace
}  // namespace lattice_planner::testing
