// SPDX-License-Identifier: BSD-3-Clause
// The search against brute force: admissible heuristics, optimal plans, honest bounds.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "lattice_planner/distance_field.h"
#include "lattice_planner/goal_table.h"
#include "oracle.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

/// A coarse lattice, so that brute force comes to an end: 0.5 s, speeds {0, 0.4} x {-0.8, 0, 0.8}.
PlannerParams coarse() {
  PlannerParams params;
  params.time_step = 0.5;
  params.max_vel_x = 0.4;
  params.acc_lim_x = 0.8;
  params.max_vel_theta = 0.8;
  params.acc_lim_theta = 1.6;
  params.merge_resolution = 0.02;
  params.heading_bins = 1024;
  params.time_merge_steps = 1;
  params.suboptimality_bound = 1.0;
  params.improvement_effort = 0.0;
  params.forget_moving_people = false;
  params.max_states = 5000000;
  params.table_resolution = 0.1;
  return params;
}

/// 3 x 5 speeds: {0, 0.2, 0.4} x {-0.8, -0.4, 0, 0.4, 0.8}.
PlannerParams threeByFive() {
  PlannerParams params = coarse();
  params.acc_lim_x = 0.4;
  params.acc_lim_theta = 0.8;
  return params;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }

 private:
  std::mt19937 engine_;
};

/// A room with discs of cost and of lethal obstacles, none near the corners where tasks begin and end.
World randomWorld(Random& random, double size, int obstacles) {
  World world = World::room(size, size, 0.05);
  for (int i = 0; i < obstacles; ++i) {
    const double x = random.uniform(0.5, size - 0.5);
    const double y = random.uniform(0.5, size - 0.5);
    world.paintStatic(x, y, random.uniform(0.2, 0.35),
                      static_cast<std::uint8_t>(random.uniform(20.0, 200.0)));
    world.paintStatic(x, y, random.uniform(0.05, 0.2), sarn::kInscribedObstacle);
  }
  return world;
}

struct Heuristics {
  Heuristics(const PlannerParams& params, const World& world, const sarn::Pose2D& goal)
      : lattice(params), table(params, lattice), goal_from_map(sarn::inverse(goal)) {
    for (std::size_t c = 0; c < 256; ++c) {
      blocked[c] = static_cast<int>(c) >= params.forbidden_cost;
      rate[c] = static_cast<float>(lattice.costPerMetre() + params.static_weight * static_cast<double>(c) /
                                                                252.0 / lattice.maxSpeed());
    }
    DistanceFieldTask task;
    task.geometry = world.view().geometry;
    task.costs = world.view().static_costs;
    task.blocked = &blocked;
    task.rate = &rate;
    task.goal_x = goal.x;
    task.goal_y = goal.y;
    task.goal_radius = params.xy_goal_tolerance;
    task.floor_radius = table.radius();
    task.floor = [this, geometry = task.geometry](const sarn::CellIndex& cell) {
      const Eigen::Vector2d p = goal_from_map * geometry.center(cell);
      return table.floorAt(p.x(), p.y());
    };
    field.reset(task);
  }
  std::array<bool, 256> blocked{};
  std::array<float, 256> rate{};
  MotionLattice lattice;
  GoalTable table;
  sarn::Pose2D goal_from_map;
  DistanceField field;
};

TEST(Heuristics, neverExceedTheCostToGoOfBruteForceOnRandomMaps) {
  const PlannerParams params = coarse();
  Random random(11);
  int compared = 0;
  for (int map = 0; map < 5; ++map) {
    const World world = randomWorld(random, 1.5, map / 2);
    const PlanRequest task =
        request({0.25, 0.25, random.uniform(-3.0, 3.0)}, {1.25, 1.25, random.uniform(-3.0, 3.0)});
    const Oracle::Solution optimum = Oracle(params, world, 0.02).solve(task);
    if (optimum.states.empty()) continue;
    Heuristics heuristics(params, world, task.goal);
    for (std::size_t i = 0; i < optimum.states.size(); ++i) {
      const Oracle::State& s = optimum.states[i];
      const auto cell = world.view().geometry.cellAt(s.pose.x, s.pose.y);
      const Eigen::Vector2d p = heuristics.goal_from_map * s.pose.position();
      EXPECT_LE(static_cast<double>(heuristics.field.at(*cell)), optimum.costs_to_go[i] + 1e-4)
          << "field, map " << map << ", " << p.transpose();
      EXPECT_LE(static_cast<double>(
                    heuristics.table.at(p.x(), p.y(), s.pose.theta - task.goal.theta, s.v, s.omega).bound),
                optimum.costs_to_go[i] + 1e-4)
          << "table, map " << map << ", " << p.transpose() << ", turn " << s.pose.theta - task.goal.theta;
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

TEST(Heuristics, reachMostOfTheCostToGoInTheOpen) {
  const PlannerParams params = coarse();
  const World world = World::room(2.4, 0.8);
  Heuristics heuristics(params, world, {1.9, 0.4, 0.0});
  const PlanRequest task = request({0.42, 0.4, 0.0}, {1.9, 0.4, 0.0});
  const double optimum = Oracle(params, world, 0.02).solve(task).cost;
  EXPECT_GT(static_cast<double>(heuristics.field.at({8, 8})), 0.7 * optimum);
}

TEST(LatticePlanner, findsTheOptimumOfBruteForceAmongObstacles) {
  const PlannerParams params = coarse();
  LatticePlanner planner(params);
  Random random(5);
  for (int map = 0; map < 5; ++map) {
    const World world = randomWorld(random, 1.5, map / 2);
    const PlanRequest task =
        request({0.25, 0.25, random.uniform(-3.0, 3.0)}, {1.25, 1.25, random.uniform(-3.0, 3.0)});
    const double optimum = Oracle(params, world, 0.02).solve(task).cost;
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete) << map;
    EXPECT_DOUBLE_EQ(result.bound, 1.0);
    // Both merge states within 2 cm, each in its own grid: equal up to what merging can lose.
    EXPECT_NEAR(result.cost, optimum, 0.01 * optimum) << map;
    EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
  }
}

TEST(LatticePlanner, findsTheOptimumOfBruteForceAmongPeople) {
  PlannerParams params = coarse();
  LatticePlanner planner(params);
  for (const double speed : {0.3, 0.6}) {
    World world = World::room(1.6, 1.2);
    world.addLayers(10, 0.5);
    world.walk(0.8, 1.3, 0.0, -speed, 0.15);
    const PlanRequest task = request({0.25, 0.5, 0.0}, {1.3, 0.5, 0.0});
    const double optimum = Oracle(params, world, 0.02).solve(task).cost;
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete);
    EXPECT_NEAR(result.cost, optimum, 0.01 * optimum) << speed;
    EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
  }
}

TEST(LatticePlanner, findsTheOptimumOfBruteForceWithThreeByFiveSpeedsFromAnyOfThem) {
  const PlannerParams params = threeByFive();
  LatticePlanner planner(params);
  Random random(17);
  const std::array<sarn::Twist2D, 4> starts = {{{0.0, 0.0}, {0.4, 0.0}, {0.2, -0.8}, {0.4, 0.4}}};
  for (const sarn::Twist2D& start : starts) {
    World world = World::room(1.3, 0.8);
    world.paintStatic(0.7, random.uniform(0.0, 0.2), 0.2, sarn::kInscribedObstacle);
    world.paintStatic(0.8, 0.6, 0.25, 100);
    PlanRequest task = request({0.2, 0.4, 0.3}, {1.05, 0.45, random.uniform(-0.5, 0.5)});
    task.start.v = start.v;
    task.start.omega = start.omega;
    const double optimum = Oracle(params, world, 0.02).solve(task).cost;
    const PlanResult result = planner.plan(task, world.view());
    ASSERT_EQ(result.status, PlanStatus::kComplete) << start.v << ", " << start.omega;
    EXPECT_DOUBLE_EQ(result.bound, 1.0);
    EXPECT_NEAR(result.cost, optimum, 0.01 * optimum) << start.v << ", " << start.omega;
    EXPECT_TRUE(faults(result.trajectory, task, params, world).empty());
  }
}

// More work never makes a plan dearer, nor its bound larger: neither by the weight that falls nor in columns.
TEST(LatticePlanner, neverLosesByGoingOn) {
  Random random(29);
  int improved = 0;
  for (int map = 0; map < 6; ++map) {
    World world = randomWorld(random, 2.4, 3 + map);
    if (map % 2 == 1) {
      world.addLayers(10, 0.5);
      world.walk(random.uniform(0.8, 1.6), 2.2, 0.0, -0.4, 0.15);
    }
    const PlanRequest task = request({0.25, 0.25, random.uniform(-3.0, 3.0)}, {2.1, 2.1, 0.5});
    PlanResult last;
    for (const int expansions : {200, 400, 800, 1600, 3200, 6400, 12800}) {
      PlannerParams params = coarse();
      params.merge_resolution = 0.05;
      params.heading_bins = 32;
      params.table_radius = 0.0;  // quickly built
      params.max_expansions = expansions;
      params.promising_expansions = map < 3 ? 0 : 100000;
      params.improvement_effort = map < 3 ? 0.0 : 0.1;
      params.least_improvement = 50;
      LatticePlanner planner(params);
      const PlanResult result = planner.plan(task, world.view());
      if (last.status == PlanStatus::kComplete) {
        ASSERT_EQ(result.status, PlanStatus::kComplete) << map << ", " << expansions;
        EXPECT_LE(result.cost, last.cost) << map << ", " << expansions;
        EXPECT_LE(result.bound, last.bound + 1e-12) << map << ", " << expansions;
        if (result.cost < last.cost) ++improved;
      }
      last = result;
    }
    EXPECT_EQ(last.status, PlanStatus::kComplete) << map;
  }
  EXPECT_GT(improved, 3) << "or nothing was tested";
}

TEST(LatticePlanner, boundsWhatItLosesHonestly) {
  PlannerParams params = coarse();
  params.heuristic_weight = 3.0;
  params.improvement_effort = 1e-6;  // the first solution, a few hundred expansions later
  LatticePlanner hasty(params);
  Random random(3);
  const World world = randomWorld(random, 1.8, 4);
  const PlanRequest task = request({0.25, 0.25, 0.0}, {1.5, 1.5, 2.0});
  const double optimum = Oracle(params, world, 0.02).solve(task).cost;
  const PlanResult result = hasty.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_LE(result.cost / result.bound, optimum * 1.01);
  EXPECT_GE(result.cost, optimum * 0.99);
}

}  // namespace
}  // namespace lattice_planner::testing
