// SPDX-License-Identifier: BSD-3-Clause
// What the planner does in worlds drawn by hand.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "lattice_planner/commit.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PlannerParams defaults() {
  PlannerParams params;
  params.table_radius = 0.6;  // smaller than by default: built once a test
  return params;
}

LatticePlanner& planner() {
  static LatticePlanner shared(defaults());
  return shared;
}

struct DrawnTask {
  const char* name;
  std::vector<std::string> rows;  // cells of 0.1 m, already inflated
  sarn::Pose2D start;
  sarn::Pose2D goal;
};

/// The map suite: every planner configuration must solve all of it.
std::vector<DrawnTask> suite() {
  return {
      {"open", std::vector<std::string>(20, std::string(30, '.')), {0.5, 1.0, 0.0}, {2.5, 1.0, 0.0}},
      {"turn in place", std::vector<std::string>(10, std::string(10, '.')), {0.5, 0.5, 0.0}, {0.5, 0.5, 3.1}},
      {"wall with a gap",
       {"....................", "....................", ".........##.........", ".........##.........",
        "....................", "....................", ".........##.........", ".........##.........",
        ".........##.........", ".........##........."},
       {0.3, 0.2, 0.0},
       {1.7, 0.2, 0.0}},
      {"dead end facing the goal",
       {"....................", "....................", "..........######....", "...............#....",
        "...............#....", "...............#....", "..........######....", "....................",
        "....................", "...................."},
       {1.25, 0.55, 0.0},
       {1.85, 0.55, 0.0}},
      {"corridor with a corner",
       {"####################", "#..................#", "#..................#", "#...################",
        "#...################", "#...################", "#...################", "#...################",
        "####################"},
       {0.25, 0.15, 1.57},
       {1.75, 0.65, 0.0}},
      {"behind the robot",
       std::vector<std::string>(20, std::string(30, '.')),
       {2.5, 1.0, 0.0},
       {0.5, 1.0, 0.0}},
  };
}

void expectSolved(LatticePlanner& planner, const DrawnTask& drawn) {
  const World world(drawn.rows, 0.1);
  const PlanRequest task = request(drawn.start, drawn.goal);
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete) << drawn.name << ": " << toString(result.status);
  for (const std::string& fault : faults(result.trajectory, task, planner.params(), world)) {
    ADD_FAILURE() << drawn.name << ": " << fault;
  }
  const sarn::TrajectoryPoint& end = result.trajectory.points.back();
  EXPECT_LT(std::hypot(end.x - drawn.goal.x, end.y - drawn.goal.y), planner.params().xy_goal_tolerance)
      << drawn.name;
  EXPECT_LT(std::abs(sarn::angleDifference(end.theta, drawn.goal.theta)),
            planner.params().yaw_goal_tolerance);
}

TEST(MapSuite, isSolvedByDefault) {
  for (const DrawnTask& drawn : suite()) expectSolved(planner(), drawn);
}

TEST(MapSuite, isSolvedWithReverseMotion) {
  PlannerParams params = defaults();
  params.min_vel_x = -0.25;
  LatticePlanner reversing(params);
  for (const DrawnTask& drawn : suite()) expectSolved(reversing, drawn);
}

TEST(MapSuite, isSolvedOnTheAncestorsLattice) {
  PlannerParams params = defaults();
  ASSERT_TRUE(sarn::setFromYaml(YAML::LoadFile("config/ancestor.yaml"), params).empty());
  LatticePlanner ancestor(params);
  for (const DrawnTask& drawn : suite()) expectSolved(ancestor, drawn);
}

TEST(MapSuite, isSolvedWithoutTable) {
  PlannerParams params = defaults();
  params.table_radius = 0.0;
  LatticePlanner plain(params);
  for (const DrawnTask& drawn : suite()) expectSolved(plain, drawn);
}

TEST(LatticePlanner, reversesOutOfADeadEndWhenItMay) {
  PlannerParams params = defaults();
  params.min_vel_x = -0.25;
  LatticePlanner reversing(params);
  const World world = World::room(2.0, 0.6);
  const PlanResult result = reversing.plan(request({1.0, 0.3, 0.0}, {0.7, 0.3, 0.0}), world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  double slowest = 0.0;
  for (const auto& p : result.trajectory.points) slowest = std::min(slowest, p.v);
  EXPECT_LT(slowest, 0.0);
}

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
  EXPECT_EQ(status(a, {1.05, 0.15, 0.0}), PlanStatus::kGoalOccupied) << "unknown is forbidden by default";
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

TEST(LatticePlanner, staysWithinItsMemory) {
  PlannerParams params = defaults();
  params.max_states = 2000;
  LatticePlanner small(params);
  World world = World::room(6.0, 6.0);
  world.paintStatic(3.0, 3.0, 1.5, sarn::kLethalObstacle);
  const PlanResult result = small.plan(request({0.5, 3.0, 3.0}, {5.5, 3.0, 3.0}), world.view());
  EXPECT_TRUE(isDrivable(result.status));
  EXPECT_LT(result.generated, 40000U);
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
