// SPDX-License-Identifier: BSD-3-Clause
// What the method's published implementation (Kollmitz et al. 2015) does wrong, one test for each fault that
// belongs to the planner's core. doc/weaknesses.md lists the faults of the other packages and where they are
// tested.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "../bench/ancestor_search.h"
#include "../bench/textbook.h"
#include "count_allocations.h"
#include "lattice_planner/distance_field.h"
#include "lattice_planner/motion_lattice.h"
#include "sarn_common/parameters.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

/// config/ancestor.yaml, with a small table.
PlannerParams ancestor() {
  PlannerParams params;
  const auto problems = sarn::setFromYaml(YAML::LoadFile("config/ancestor.yaml"), params);
  EXPECT_TRUE(problems.empty());
  params.table_radius = 0.6;
  return params;
}

PlannerParams defaults() {
  PlannerParams params;
  params.table_radius = 0.6;
  return params;
}

/// A corridor along x with a wall across it that leaves a doorway of 0.5 m in the middle.
World doorway() {
  World world = World::room(4.0, 1.5);
  for (double y = 0.025; y < 1.5; y += 0.05) {
    if (y > 0.5 && y < 1.0) continue;
    for (double x = 1.925; x < 2.1; x += 0.05) {
      world.setStatic(*world.view().geometry.cellAt(x, y), sarn::kLethalObstacle);
    }
  }
  return world;
}

// Faults 1 and 8: the first way that is generated wins, the goal is accepted when it is generated, and costs
// are counted by samples. On the ancestor's own lattice and cost, searched to the end, nothing is dearer than
// the textbook's plan, nor than the ancestor's.
TEST(AncestorsFaults, plansOnItsLatticeAreAsCheapAsTheTextbooks) {
  PlannerParams params = ancestor();
  params.improvement_effort = 0.0;
  params.hurry_after = 0;
  LatticePlanner planner(params);
  bench::Textbook textbook(params);
  bench::AncestorSearch ancestors(params);
  int compared = 0;
  for (const double yaw : {0.0, 2.0, -1.3}) {
    World world = World::room(3.0, 1.2);
    world.paintStatic(1.4, 0.3, 0.3, 120);
    world.paintStatic(1.4, 0.3, 0.1, sarn::kInscribedObstacle);
    world.addLayers(15, 0.5);
    world.walk(1.6, 2.5, 0.0, -0.6, 0.2);
    const PlanRequest task = request({0.5, 0.6, 0.3}, {2.3, 0.6, yaw});
    const std::optional<double> optimum = textbook.solve(task, world.view());
    const std::optional<bench::AncestorSearch::Plan> ancestor = ancestors.solve(task, world.view());
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_TRUE(optimum.has_value());
    ASSERT_TRUE(ancestor.has_value());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    EXPECT_NEAR(result.cost, *optimum, 0.015 * *optimum) << yaw;  // both merge states of one cell
    EXPECT_LE(result.cost, 1.005 * ancestor->cost) << yaw;
    const std::optional<double> charged = ancestors.task().costOf(result.trajectory);
    ASSERT_TRUE(charged.has_value());
    EXPECT_NEAR(result.cost, *charged, 1e-3 * *charged) << yaw;  // as the ancestor would charge for it
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

// Fault 2: the heuristic knows neither heading nor speed nor people; turning at the goal is searched blindly.
TEST(AncestorsFaults, turningAtTheGoalIsForeseen) {
  LatticePlanner planner(ancestor());
  const World world = World::room(6.0, 3.0);
  for (const double yaw : {0.0, 1.57, 3.1, -1.57}) {
    const PlanResult result = planner.plan(request({0.6, 1.5, 0.0}, {5.2, 1.5, yaw}), world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    EXPECT_LT(result.expansions, 2000U) << yaw;  // the ancestor: tens of thousands
  }
}

// Fault 3: when time is up the ancestor drives to the state that looks cheapest, perhaps still moving, and
// calls it a plan.
TEST(AncestorsFaults, whatIsCutShortSaysSoStandsAtItsEndAndIsCloser) {
  int cut = 0;
  for (const int expansions : {20, 60, 150}) {
    PlannerParams params = ancestor();
    params.max_expansions = expansions;
    LatticePlanner planner(params);
    const World world = doorway();
    const PlanRequest task = request({0.4, 0.75, 3.0}, {3.6, 0.75, 0.0});
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_FALSE(result.trajectory.empty());
    const auto& end = result.trajectory.points.back();
    EXPECT_EQ(end.v, 0.0);
    EXPECT_EQ(end.omega, 0.0);
    if (result.status == PlanStatus::kComplete) continue;
    ++cut;
    EXPECT_TRUE(result.timed_out);
    EXPECT_LE(std::hypot(end.x - 3.6, end.y - 0.75), std::hypot(0.4 - 3.6, 0.0) + 1e-9);
  }
  EXPECT_GT(cut, 0) << "or nothing was tested";
}

// Fault 3, too: where people run over every place that can be reached, two plans of 0.1 m were called a
// success.
TEST(AncestorsFaults, peopleWhoRunOverEveryPlaceLeaveNoPlanThatIsCalledComplete) {
  World world = World::room(3.0, 1.0);
  world.addLayers(20, 0.5);
  for (int layer = 4; layer < 20; ++layer) world.paint(layer, 1.0, 0.5, 1.6);  // everywhere near, from 2 s on
  for (const bool forget : {true, false}) {
    PlannerParams params = defaults();
    params.forget_moving_people = forget;
    params.max_expansions = 20000;
    LatticePlanner planner(params);
    const PlanRequest task = request({0.4, 0.5, sarn::kPi}, {2.8, 0.5, 0.0});
    const PlanResult result = planner.plan(task, world.view());
    EXPECT_NE(result.status, PlanStatus::kComplete) << forget;
    EXPECT_NE(result.status, PlanStatus::kGoalAnyPose) << forget;
    ASSERT_FALSE(result.trajectory.empty()) << forget;
    EXPECT_EQ(result.trajectory.points.back().v, 0.0) << forget;
  }
}

// Fault 4: the ancestor sleeps until its time is up. Here a plan in hand comes back: this test would take a
// day.
TEST(AncestorsFaults, doesNotUseUpItsTime) {
  LatticePlanner planner(defaults());
  const World world = World::room(2.0, 2.0);
  const PlanResult result = planner.plan(request({0.5, 1.0, 0.0}, {1.5, 1.0, 0.0}, 86400.0), world.view());
  EXPECT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_FALSE(result.timed_out);
}

// Fault 5: limits that are no exact multiples of a step in binary become unreachable, as sums are compared.
TEST(AncestorsFaults, limitsAreReachedWhateverTheirBinaryDigits) {
  PlannerParams params;
  params.time_step = 0.1;
  params.acc_lim_x = 1.0;
  params.max_vel_x = 0.3;
  params.acc_lim_theta = 7.0;
  params.max_vel_theta = 2.1;
  ASSERT_TRUE(sarn::problems(params).empty());
  const MotionLattice lattice(params);
  EXPECT_DOUBLE_EQ(lattice.v(lattice.forwardSpeeds() - 1), 0.3);
  EXPECT_DOUBLE_EQ(lattice.omega(lattice.angularSpeeds() - 1), 2.1);
  bool reached = false;
  for (const MotionPrimitive& p : lattice.from(lattice.forwardSpeeds() - 2, lattice.standingOmega())) {
    reached = reached || p.v == lattice.forwardSpeeds() - 1;
  }
  EXPECT_TRUE(reached);
}

// Fault 6: from 7 s on the ancestor cannot represent waiting, and sees people frozen where they were then.
TEST(AncestorsFaults, waitsLongerThanSevenSecondsForADoorway) {
  World world = doorway();
  world.addLayers(40, 0.5);
  for (int layer = 0; layer < 24; ++layer) world.paint(layer, 2.0, 0.75, 0.45);  // somebody, until 12 s
  PlannerParams params = defaults();
  params.forget_moving_people = false;
  LatticePlanner planner(params);
  const PlanRequest task = request({1.0, 0.75, 0.0}, {3.2, 0.75, 0.0});
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
  double passes = 0.0;
  for (const auto& p : result.trajectory.points) passes = p.x < 2.0 ? p.t : passes;
  EXPECT_GT(passes, 11.0);
  EXPECT_LT(result.trajectory.endTime(), 20.0);
}

// Fault 7: seventeen heading bins, of which the first and the last are two halves of one.
TEST(AncestorsFaults, headingsHaveNoSeam) {
  PlannerParams params = ancestor();
  params.improvement_effort = 0.0;
  params.hurry_after = 0;
  LatticePlanner planner(params);
  const World world = World::room(2.0, 2.0);
  double first = -1.0;
  for (const double yaw : {0.0, 0.5 * sarn::kPi, sarn::kPi, -0.5 * sarn::kPi}) {  // a turn of the whole task
    const sarn::Pose2D turned{0.975, 0.975, yaw};
    const sarn::Pose2D start = turned * sarn::Pose2D{-0.5, 0.0, 0.0};
    const sarn::Pose2D goal = turned * sarn::Pose2D{0.5, 0.0, 0.0};
    const PlanResult result = planner.plan(request(start, {goal.x, goal.y, yaw}), world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    if (first < 0.0) first = result.cost;
    EXPECT_NEAR(result.cost, first, 0.01 * first) << yaw;
  }
}

// Fault 9: a whole action is judged by the people at its beginning.
TEST(AncestorsFaults, peopleAreMetWhereTheyAreDuringAnAction) {
  PlannerParams params = defaults();
  params.time_step = 0.5;
  params.acc_lim_x = 1.0;
  params.acc_lim_theta = 2.0;
  World world = World::room(4.0, 1.0);
  world.addLayers(60, 0.1);
  for (int layer = 0; layer < 60; ++layer) {  // 2 m/s across the way
    world.paint(layer, 2.0, -3.0 + 0.2 * (layer + 0.5), 0.35);
  }
  LatticePlanner planner(params);
  const PlanRequest task = request({0.8, 0.5, 0.0}, {3.2, 0.5, 0.0});
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
}

// Fault 8: standing in cost c pays nine samples, both ends of a step twice. Here a second in it costs the
// same however it is spent.
TEST(AncestorsFaults, waitingInACostPaysByTheSecond) {
  PlannerParams params = defaults();
  params.improvement_effort = 0.0;
  LatticePlanner planner(params);
  World world = World::room(3.0, 0.4);
  world.addLayers(12, 0.5);
  world.paintStatic(0.4, 0.2, 0.6, 63);  // a quarter of the full cost at the start
  for (int layer = 0; layer < 8; ++layer) world.paint(layer, 1.5, 0.2, 0.45);  // somebody, until 4 s
  const PlanResult result = planner.plan(request({0.4, 0.2, 0.0}, {2.6, 0.2, 0.0}), world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  double exposed = 0.0;  // [s] in the cost, by fine sampling
  for (double t = 0.0; t < result.trajectory.endTime(); t += 0.005) {
    const auto p = result.trajectory.sample(t + 0.0025);
    if (world.costAt(p.x, p.y, 1e9) == 63) exposed += 0.005;
  }
  ASSERT_GT(exposed, 1.0);
  double rest =
      result.trajectory.endTime() * params.time_weight + result.trajectory.length() * params.length_weight;
  for (std::size_t i = 1; i < result.trajectory.points.size(); ++i) {
    const auto& p = result.trajectory.points;
    rest += params.rotation_weight * std::abs(0.5 * (p[i - 1].omega + p[i].omega)) * params.time_step;
  }
  EXPECT_NEAR(result.cost - rest, exposed * params.static_weight * 63.0 / 252.0, 0.1);
}

// Fault 15: arrays are sized once; a map of another size is read out of bounds.
TEST(AncestorsFaults, mapsChangeTheirSizeBetweenPlans) {
  LatticePlanner planner(defaults());
  for (const double size : {2.0, 5.0, 1.6, 3.0, 3.0}) {
    for (const double resolution : {0.05, 0.1}) {
      World world = World::room(size, size, resolution);
      world.addLayers(4, 0.5);
      world.walk(0.5 * size, 0.5 * size, 0.4, 0.1);
      const PlanRequest task = request({0.5, 0.5, 0.0}, {size - 0.5, size - 0.5, 1.0});
      LatticePlanner fresh(defaults());
      const PlanResult result = planner.plan(task, world.view());
      EXPECT_EQ(result.status, PlanStatus::kComplete);
      EXPECT_DOUBLE_EQ(result.cost, fresh.plan(task, world.view()).cost);  // nothing is left of the last map
    }
  }
}

// Faults 17 and 18: the ancestor takes several pieces of heap a state and gives some back never.
TEST(AncestorsFaults, takesNoHeapForStatesOnceItIsWarm) {
  LatticePlanner planner(defaults());
  World world = doorway();
  world.addLayers(20, 0.5);
  world.walk(2.0, -1.0, 0.0, 0.4);
  const PlanRequest task = request({0.4, 0.75, 3.0}, {3.6, 0.75, 0.0});
  std::size_t expansions = 0;
  for (int warm_up = 0; warm_up < 3; ++warm_up) expansions = planner.plan(task, world.view()).expansions;
  const std::size_t before = allocations();
  const PlanResult result = planner.plan(task, world.view());
  const std::size_t taken = allocations() - before;
  ASSERT_EQ(result.expansions, expansions);
  EXPECT_GT(expansions, 500U);
  EXPECT_LT(taken, 40U);  // the trajectory, layers of the view
}

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

TEST(Robustness, anyNumberOfPeopleAndAnyTimeGivesOneOutcome) {
  LatticePlanner planner(defaults());
  World world = World::room(3.0, 3.0);
  world.addLayers(10, 0.5);
  for (int i = 0; i < 200; ++i) world.walk(0.1 * (i % 30), 0.1 * (i / 7), 0.3, -0.2, 0.1);
  for (const double time : {-1e9, -3.0, 0.0, 1e9}) {  // people long ago, or far ahead
    PlanRequest task = request({1.0, 1.0, 0.0}, {2.0, 2.0, 0.0});
    task.start.t = time;
    const PlanResult result = planner.plan(task, world.view());
    EXPECT_NE(result.status, PlanStatus::kInvalidRequest) << time;
    if (!result.trajectory.empty()) {
      EXPECT_EQ(result.trajectory.points.back().v, 0.0) << time;
    }
  }
}

}  // namespace
}  // namespace lattice_planner::testing
