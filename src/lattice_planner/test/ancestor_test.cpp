// SPDX-License-Identifier: BSD-3-Clause
// What the method's published implementation (Kollmitz et al. 2015) does wrong, one test for each fault that
// belongs to the planner's core. doc/weaknesses.md lists the faults of the other packages and where they are
// tested.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "../bench/ancestor_search.h"
#include "../bench/textbook.h"
#include "../src/merge_key.h"
#include "count_allocations.h"
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

// Faults 1 and 8: the first way that is generated wins, the goal is accepted when it is generated, and costs
// are counted by samples. On the ancestor's own lattice and cost, searched to the end, nothing is dearer than
// the textbook's plan; the ancestor's is.
TEST(AncestorsFaults, plansOnItsLatticeAreAsCheapAsTheTextbooks) {
  PlannerParams params = ancestor();
  params.improvement_effort = 0.0;
  params.hurry_after = 0;
  LatticePlanner planner(params);
  bench::Textbook textbook(params);
  bench::AncestorSearch ancestors(params);
  int compared = 0;
  double worst_of_ancestor = 0.0;
  for (const double yaw : {0.0, 2.0, -1.3}) {
    World world = World::room(3.0, 1.2);
    world.paintStatic(1.4, 0.3, 0.3, 120);
    world.paintStatic(1.4, 0.3, 0.1, sarn::kInscribedObstacle);
    world.addLayers(15, 0.5);
    world.walk(1.6, 2.5, 0.0, -0.6, 0.2);
    const PlanRequest task = request({0.5, 0.6, 0.3}, {2.3, 0.6, yaw});
    const std::optional<double> optimum = textbook.solve(task, world.view());
    const bench::AncestorSearch::Plan ancestor = ancestors.solve(task, world.view());
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_TRUE(optimum.has_value());
    ASSERT_TRUE(ancestor.reached);
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    EXPECT_NEAR(result.cost, *optimum, 0.015 * *optimum) << yaw;  // both merge states of one cell
    EXPECT_LE(result.cost, 1.005 * ancestor.cost) << yaw;
    worst_of_ancestor = std::max(worst_of_ancestor, ancestor.cost / *optimum);
    const std::optional<double> charged = ancestors.task().costOf(result.trajectory);
    ASSERT_TRUE(charged.has_value());
    EXPECT_NEAR(result.cost, *charged, 1e-3 * *charged) << yaw;  // as the ancestor would charge for it
    ++compared;
  }
  EXPECT_EQ(compared, 3);
  EXPECT_GT(worst_of_ancestor, 1.02);
}

// Fault 2: the heuristic knows neither heading nor speed nor people; turning at the goal is searched blindly.
TEST(AncestorsFaults, turningAtTheGoalIsForeseen) {
  LatticePlanner planner(ancestor());
  bench::AncestorSearch ancestors(ancestor());
  const World world = World::room(6.0, 3.0);
  for (const double yaw : {0.0, 1.57, 3.1, -1.57}) {
    const PlanRequest task = request({0.6, 1.5, 0.0}, {5.2, 1.5, yaw});
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    EXPECT_LT(result.expansions, 2000U) << yaw;
    if (yaw != 0.0) {
      EXPECT_GT(ancestors.solve(task, world.view()).expansions, 8000U) << yaw;
    }
  }
}

// Fault 2, too: between the eight directions of its wavefront it says more than a plan costs.
TEST(AncestorsFaults, nothingIsEstimatedAboveItsCost) {
  const PlannerParams params = ancestor();
  const World world = World::room(6.0, 3.0);
  const double aslant = 0.125 * sarn::kPi;
  const sarn::Pose2D start{0.6, 0.6, aslant};
  const PlanRequest task = request(start, start * sarn::Pose2D{4.94, 0.0, 0.0});
  sarn::TimedTrajectory straight{{task.start}};
  for (int i = 1; i <= 25; ++i) {  // into the goal's tolerance
    const sarn::Pose2D p = start * sarn::Pose2D{i < 25 ? 0.2 * i - 0.1 : 4.8, 0.0, 0.0};
    straight.points.push_back({p.x, p.y, p.theta, i < 25 ? 0.4 : 0.0, 0.0, 0.5 * i});
  }
  bench::AncestorTask judged(params);
  judged.reset(task, world.view());
  const std::optional<double> cost = judged.costOf(straight);
  ASSERT_TRUE(cost.has_value());
  EXPECT_GT(judged.wavefront(judged.start()), 1.02 * *cost);
  LatticePlanner planner(params);
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_LE(result.cost / result.bound, *cost);  // what ours says at least
}

// Fault 3: when time is up the ancestor drives to the state that looks cheapest, perhaps still moving, and
// calls it a plan.
TEST(AncestorsFaults, whatIsCutShortSaysSoStandsAtItsEndAndIsCloser) {
  int cut = 0;
  int ancestors_that_move = 0;
  bench::AncestorSearch ancestors(ancestor());
  const World world = doorway();
  const PlanRequest task = request({0.4, 0.75, 3.0}, {3.6, 0.75, 0.0});
  for (const int expansions : {20, 60, 150}) {
    PlannerParams params = ancestor();
    params.max_expansions = expansions;
    LatticePlanner planner(params);
    const auto theirs = ancestors.solve(task, world.view(), static_cast<std::size_t>(expansions));
    ASSERT_FALSE(theirs.trajectory.empty());
    const auto& their_end = theirs.trajectory.points.back();
    if (!theirs.reached && (their_end.v != 0.0 || their_end.omega != 0.0)) ++ancestors_that_move;
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
  EXPECT_GT(ancestors_that_move, 0);
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
  const bench::AncestorSearch::Plan theirs = bench::AncestorSearch(ancestor()).solve(task, world.view());
  EXPECT_FALSE(theirs.reached);
  EXPECT_TRUE(theirs.trajectory.empty()) << "nothing was left to look at";
}

/// The merge cell of somebody who stands at the start with this heading.
std::uint64_t mergeKey(const PlannerParams& params, const PlanRequest& request, const World& world,
                       double heading) {
  SearchTask task(params);
  task.reset(request, world.view());
  MergeKey key(task);
  key.reset();
  SearchState state;
  state.x = request.start.x;
  state.y = request.start.y;
  state.theta = sarn::wrapAngle(heading);
  return key.of(state);
}

// Fault 7: seventeen heading bins, of which the first and the last are two halves of one.
TEST(AncestorsFaults, headingsHaveNoSeam) {
  PlannerParams params = ancestor();
  params.improvement_effort = 0.0;
  params.hurry_after = 0;
  LatticePlanner planner(params);
  const bench::AncestorSearch ancestors(params);
  const World world = World::room(2.0, 2.0);
  double first = -1.0;
  for (const double yaw : {0.0, 0.5 * sarn::kPi, sarn::kPi, -0.5 * sarn::kPi}) {  // a turn of the whole task
    const sarn::Pose2D turned{0.975, 0.975, yaw};
    const PlanRequest task =
        request(turned * sarn::Pose2D{-0.5, 0.0, 0.0}, turned * sarn::Pose2D{0.5, 0.0, 0.0});
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    if (first < 0.0) first = result.cost;
    EXPECT_NEAR(result.cost, first, 0.01 * first) << yaw;
    const bool one = ancestors.headingBin(yaw + 0.05) == ancestors.headingBin(yaw - 0.05);
    EXPECT_EQ(one, yaw != 0.0) << "the ancestor's, " << yaw;
    EXPECT_EQ(mergeKey(params, task, world, yaw + 0.05), mergeKey(params, task, world, yaw - 0.05)) << yaw;
  }
}

// Fault 9: a whole action is judged by the people at its beginning.
TEST(AncestorsFaults, peopleAreMetWhereTheyAreDuringAnAction) {
  PlannerParams params = defaults();
  params.time_step = 0.5;
  params.acc_lim_x = 1.0;
  params.acc_lim_theta = 2.0;
  LatticePlanner planner(params);
  int runs_of_ancestor_into_somebody = 0;
  for (const double crosses : {2.0, 2.5, 3.0, 3.5, 4.0}) {  // [s] 2 m/s across the way
    World world = World::room(4.0, 1.0);
    world.addLayers(80, 0.1);
    for (int layer = 0; layer < 80; ++layer) {
      world.paint(layer, 2.0, 0.5 + 2.0 * (0.1 * (layer + 0.5) - crosses), 0.35);
    }
    const PlanRequest task = request({0.8, 0.5, 0.0}, {3.2, 0.5, 0.0});
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete) << crosses;
    EXPECT_TRUE(faults(result.trajectory, task, params, world).empty()) << crosses;
    const bench::AncestorSearch::Plan theirs = bench::AncestorSearch(ancestor()).solve(task, world.view());
    ASSERT_TRUE(theirs.reached) << crosses;
    if (!faults(theirs.trajectory, task, ancestor(), world).empty()) ++runs_of_ancestor_into_somebody;
  }
  EXPECT_GT(runs_of_ancestor_into_somebody, 0);
}

/// What the ancestor charges for standing still for an action where it starts, with samples so far apart [m].
double ancestorsWait(const PlanRequest& task, const World& world, double sample_distance) {
  PlannerParams params = ancestor();
  params.collision_check_distance = sample_distance;
  bench::AncestorTask judged(params);
  judged.reset(task, world.view());
  sarn::TimedTrajectory waits;
  waits.points = {task.start, task.start};
  waits.points.back().t += params.time_step;
  return judged.costOf(waits).value_or(-1.0);
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
  const PlanRequest task = request({0.4, 0.2, 0.0}, {2.6, 0.2, 0.0});
  const PlanResult result = planner.plan(task, world.view());
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
  EXPECT_DOUBLE_EQ(ancestorsWait(task, world, 0.025), 200.0 + 9 * 63.0);  // for the same half second
  EXPECT_DOUBLE_EQ(ancestorsWait(task, world, 0.0125), 200.0 + 17 * 63.0);
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
