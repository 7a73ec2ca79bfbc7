// SPDX-License-Identifier: BSD-3-Clause
// What the planner does in worlds without people: requests, headings, limits of its effort.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "small_planner.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(LatticePlanner, namesEachBadRequest) {
  World world({"....................", "....................", "...............#....", "..........?.........",
               "...................."},
              0.1);
  const sarn::Pose2D a{0.25, 0.25, 0.0};
  const auto status = [&](const sarn::Pose2D& start, const sarn::Pose2D& goal) {
    return planner().plan(request(start, goal), world.view()).status;
  };
  EXPECT_EQ(status({kNan, 0.2, 0.0}, a), PlanStatus::kInvalidRequest);
  EXPECT_EQ(status(a, {0.2, 0.2, kNan}), PlanStatus::kInvalidRequest);
  EXPECT_EQ(status({-0.1, 0.2, 0.0}, a), PlanStatus::kStartOutsideMap);
  EXPECT_EQ(status(a, {0.2, 55.0, 0.0}), PlanStatus::kGoalOutsideMap);
  EXPECT_EQ(status(a, {1e300, 0.2, 0.0}), PlanStatus::kGoalOutsideMap);
  EXPECT_EQ(status({1.55, 0.25, 0.0}, a), PlanStatus::kStartOccupied);
  EXPECT_EQ(status(a, {1.55, 0.25, 0.0}), PlanStatus::kGoalOccupied);
  EXPECT_EQ(status(a, {1.05, 0.15, 0.0}), PlanStatus::kGoalUnknown) << "unknown is forbidden by default";
  EXPECT_EQ(planner().plan(request(a, a, 0.0), world.view()).status, PlanStatus::kInvalidRequest);
  EXPECT_EQ(planner().plan(request(a, a, kNan), world.view()).status, PlanStatus::kInvalidRequest);
  sarn::TimedCostmapView broken = world.view();
  broken.static_costs = nullptr;
  EXPECT_EQ(planner().plan(request(a, a), broken).status, PlanStatus::kInvalidRequest);
  broken = world.view();
  broken.layers.push_back(nullptr);
  EXPECT_EQ(planner().plan(request(a, a), broken).status, PlanStatus::kInvalidRequest);
  broken = world.view();
  broken.layer_duration = 0.0;
  EXPECT_EQ(planner().plan(request(a, a), broken).status, PlanStatus::kInvalidRequest);
}

TEST(LatticePlanner, entersUnknownOnlyWhenAllowed) {
  const std::vector<std::string> rows(6, "..........????..........");
  const World world(rows, 0.1);
  const PlanRequest task = request({0.3, 0.3, 0.0}, {2.1, 0.3, 0.0});
  EXPECT_EQ(planner().plan(task, world.view()).status, PlanStatus::kNoPath);
  PlannerParams params = defaults();
  params.allow_unknown = true;
  LatticePlanner bold(params);
  EXPECT_EQ(bold.plan(task, world.view()).status, PlanStatus::kComplete);
}

TEST(LatticePlanner, endsWhenItIsToldTo) {
  const World world = World::room(8.0, 8.0);
  PlanRequest task = request({0.5, 0.5, 0.0}, {7.5, 7.5, 0.0});
  const PlanResult whole = planner().plan(task, world.view());
  ASSERT_EQ(whole.status, PlanStatus::kComplete);
  ASSERT_GT(whole.expansions, 64U);
  task.stop = [] { return true; };
  const PlanResult told = planner().plan(task, world.view());
  EXPECT_NE(told.status, PlanStatus::kComplete);
  EXPECT_TRUE(told.timed_out);
  EXPECT_LT(told.expansions, 32U);
  int asked = 0;
  task.stop = [&asked] { return ++asked > 1000000; };
  EXPECT_EQ(planner().plan(task, world.view()).status, PlanStatus::kComplete) << "was not told to";
  EXPECT_GT(asked, 0);
}

TEST(LatticePlanner, tellsWhenTheFirstPlanWasThere) {
  const World world = World::room(4.0, 4.0);
  const PlanResult found = planner().plan(request({0.5, 0.5, 0.0}, {3.5, 3.5, 0.0}), world.view());
  ASSERT_EQ(found.status, PlanStatus::kComplete);
  EXPECT_GT(found.first_plan_time, 0.0);
  EXPECT_LE(found.first_plan_time, found.search_time);
  EXPECT_EQ(planner().plan(request({0.5, 0.5, 0.0}, {9.0, 0.5, 0.0}), world.view()).first_plan_time, 0.0);
}

// Found by the fuzz target: the place after the first action had no index.
TEST(LatticePlanner, answersAStartOfAnySpeedWhereCellsAreCharged) {
  const World world = World::room(4.0, 4.0);
  PlannerParams params;
  params.charge_cells = true;
  LatticePlanner charging(params);
  for (const double v : {1e12, -1e12, 1e300}) {
    PlanRequest task = request({0.5, 0.5, 0.0}, {3.5, 3.5, 0.0});
    task.start.v = v;
    EXPECT_FALSE(isDrivable(charging.plan(task, world.view()).status)) << v;
  }
}

TEST(LatticePlanner, standsStillWhenItIsAtTheGoal) {
  const World world = World::room(1.0, 1.0);
  const PlanResult result = planner().plan(request({0.5, 0.5, 0.0}, {0.55, 0.5, 0.1}), world.view());
  EXPECT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_EQ(result.trajectory.points.size(), 1U);
  EXPECT_DOUBLE_EQ(result.cost, 0.0);
}

TEST(LatticePlanner, saysNoPathAndBrakesWhenTheGoalIsWalledIn) {
  const World world({"..........", "......####", "......#...", "......#...", "......####", ".........."},
                    0.1);
  PlanRequest task = request({0.15, 0.25, 0.0}, {0.85, 0.25, 0.0});
  task.start.v = 0.25;
  const PlanResult result = planner().plan(task, world.view());
  EXPECT_EQ(result.status, PlanStatus::kNoPath);
  EXPECT_FALSE(isDrivable(result.status));
  EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world).empty());
}

TEST(LatticePlanner, hasNoSeamAtPi) {
  const World world = World::room(4.0, 2.0);
  double cost = -1.0;
  for (const double yaw : {sarn::kPi - 0.02, -sarn::kPi + 0.02, 3.0 * sarn::kPi - 0.02}) {
    const PlanResult result = planner().plan(request({3.5, 1.0, yaw}, {0.5, 1.0, -yaw}), world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    if (cost >= 0.0) {
      EXPECT_NEAR(result.cost, cost, 0.02 * cost);
    }
    cost = result.cost;
    for (const auto& p : result.trajectory.points)
      EXPECT_LT(std::abs(p.omega), 0.6) << "turns although it need not";
  }
}

TEST(LatticePlanner, turnsWithTheWorld) {
  // The same world turned by a quarter: the same plan, turned.
  const std::vector<std::string> rows = {"..............", "..............", "......###.....",
                                         "......###.....", "..............", "..............",
                                         "..............", ".............."};
  std::vector<std::string> turned(rows.front().size(), std::string(rows.size(), '.'));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) turned[rows[r].size() - 1 - c][r] = rows[r][c];
  }
  PlannerParams params = defaults();
  params.suboptimality_bound = 1.0;
  params.improvement_effort = 0.0;
  LatticePlanner exact(params);
  const World world(rows, 0.1);
  const World turned_world(turned, 0.1);
  const double height = 0.1 * static_cast<double>(rows.size());
  const auto turn = [&](const sarn::Pose2D& p) {
    return sarn::Pose2D{height - p.y, p.x, p.theta + 0.5 * sarn::kPi};
  };
  const sarn::Pose2D start{0.25, 0.55, 0.2};
  const sarn::Pose2D goal{1.15, 0.55, 0.0};
  const PlanResult a = exact.plan(request(start, goal), world.view());
  const PlanResult b = exact.plan(request(turn(start), turn(goal)), turned_world.view());
  ASSERT_EQ(a.status, PlanStatus::kComplete);
  ASSERT_EQ(b.status, PlanStatus::kComplete);
  EXPECT_NEAR(a.cost, b.cost, 0.02 * a.cost);
}

TEST(LatticePlanner, isTheSameEveryTimeForTheSameExpansions) {
  PlannerParams params = defaults();
  params.max_expansions = 3000;
  LatticePlanner first(params);
  LatticePlanner second(params);
  World world = World::room(4.0, 3.0);
  world.addLayers(16, 0.5);
  world.walk(2.0, 3.0, 0.0, -0.5);
  const PlanRequest task = request({0.5, 1.5, 0.0}, {3.5, 1.5, 0.0});
  const PlanResult a = first.plan(task, world.view());
  (void)second.plan(request({1.0, 1.0, 0.0}, {3.0, 2.0, 0.0}), world.view());  // leaves no trace
  const PlanResult b = second.plan(task, world.view());
  EXPECT_EQ(a.expansions, b.expansions);
  EXPECT_DOUBLE_EQ(a.cost, b.cost);
  ASSERT_EQ(a.trajectory.points.size(), b.trajectory.points.size());
  EXPECT_DOUBLE_EQ(a.trajectory.points.back().x, b.trajectory.points.back().x);
}

TEST(LatticePlanner, alwaysEndsStandingHoweverLittleItMaySearch) {
  World world = World::room(4.0, 3.0);
  world.paintStatic(2.0, 1.5, 0.5, sarn::kLethalObstacle);
  for (const int expansions : {1, 2, 5, 10, 30, 100, 300}) {
    PlannerParams params = defaults();
    params.table_radius = 0.0;
    params.max_expansions = expansions;
    LatticePlanner limited(params);
    PlanRequest task = request({0.5, 1.5, 0.0}, {3.5, 1.5, 0.0});
    task.start.v = 0.5;
    task.start.omega = 0.5;
    const PlanResult result = limited.plan(task, world.view());
    EXPECT_TRUE(result.timed_out) << expansions;
    EXPECT_TRUE(isDrivable(result.status)) << expansions;
    for (const std::string& fault : faults(result.trajectory, task, params, world)) {
      ADD_FAILURE() << expansions << " expansions: " << fault;
    }
  }
}

// However hard the task: no more memory than states were allowed, and a plan that ends standing and says that
// it was cut short.
TEST(LatticePlanner, staysWithinItsMemory) {
  constexpr std::size_t kBytesAState = 150;   // see max_states
  constexpr std::size_t kOverhead = 300'000;  // [bytes] of an empty table, and of the last expansion's states
  for (const int states : {2000, 20000, 60000}) {
    PlannerParams params = defaults();
    params.max_states = states;
    params.improvement_effort = 0.0;  // on and on
    LatticePlanner small(params);
    World world = World::room(6.0, 6.0);
    world.paintStatic(3.0, 3.0, 1.5, sarn::kLethalObstacle);
    world.addLayers(20, 0.5);
    world.walk(3.0, 0.8, 0.0, 0.3);
    const PlanRequest task = request({0.5, 3.0, 3.0}, {5.5, 3.0, 3.0});
    for (int again = 0; again < 2; ++again) {  // and it does not grow from plan to plan
      const PlanResult result = small.plan(task, world.view());
      EXPECT_TRUE(isDrivable(result.status)) << states;
      EXPECT_TRUE(result.timed_out) << states;
      EXPECT_EQ(result.trajectory.points.back().v, 0.0) << states;
      EXPECT_GT(small.memory(), 60 * static_cast<std::size_t>(states)) << "or the limit was not reached";
      EXPECT_LT(small.memory(), kBytesAState * static_cast<std::size_t>(states) + kOverhead) << states;
    }
  }
}

TEST(LatticePlanner, saysNoPathWhereNothingKeepsItFromTheWall) {
  LatticePlanner& planner = testing::planner();
  const World world = World::room(2.0, 2.0);
  PlanRequest task = request({1.9, 1.0, 0.0}, {0.5, 1.0, 0.0});
  task.start.v = 0.5;
  const PlanResult result = planner.plan(task, world.view());
  EXPECT_EQ(result.status, PlanStatus::kNoPath);
  ASSERT_FALSE(result.trajectory.empty());
  EXPECT_EQ(result.trajectory.points.back().v, 0.0);
}

TEST(LatticePlanner, startsFromSpeedsOffTheLattice) {
  const World world = World::room(4.0, 2.0);
  PlanRequest task = request({0.5, 1.0, 0.0}, {3.0, 1.0, 0.0});
  task.start.v = 0.33;
  task.start.omega = -0.21;
  const PlanResult result = planner().plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(result.trajectory.points.front().v, 0.33);
  EXPECT_TRUE(faults(result.trajectory, task, planner().params(), world).empty());
}

// Cells as large as the robot must not lead the search astray: a few steps aside took it 20 times the work.
TEST(LatticePlanner, coarseCellsGuideAsWellAsFineOnes) {
  const auto work = [](double resolution) {
    World world = World::room(6.0, 4.0, resolution);
    std::array<std::size_t, 2> expansions{};  // alone, among people
    for (const double yaw : {-1.57, 0.0, 1.57, 3.1}) {
      const PlanResult aside = planner().plan(request({3.0, 2.0, 0.0}, {2.7, 2.9, yaw}), world.view());
      EXPECT_EQ(aside.status, PlanStatus::kComplete) << resolution;
      expansions[0] += aside.expansions;
    }
    world.addLayers(20, 0.5);
    world.walk(3.0, 4.0, 0.0, -0.5);
    const PlanRequest task = request({0.8, 2.0, 0.0}, {5.2, 2.6, 0.0});
    const PlanResult among_people = planner().plan(task, world.view());
    EXPECT_EQ(among_people.status, PlanStatus::kComplete) << resolution;
    EXPECT_TRUE(faults(among_people.trajectory, task, planner().params(), world).empty()) << resolution;
    expansions[1] = among_people.expansions;
    return expansions;
  };
  const auto fine = work(0.1);
  for (const double resolution : {0.25, 0.4}) {
    const auto coarse = work(resolution);
    EXPECT_LT(coarse[0], 2 * fine[0]) << resolution;
    EXPECT_LT(coarse[1], 4 * fine[1]) << resolution << " m, among people: the cells' corners lie elsewhere";
  }
}

}  // namespace
}  // namespace lattice_planner::testing
