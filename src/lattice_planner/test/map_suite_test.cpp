// SPDX-License-Identifier: BSD-3-Clause
// Worlds drawn by hand that every configuration of the planner must solve.
#include <gtest/gtest.h>

#include "small_planner.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

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

}  // namespace
}  // namespace lattice_planner::testing
