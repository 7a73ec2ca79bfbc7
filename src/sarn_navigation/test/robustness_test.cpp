// SPDX-License-Identifier: BSD-3-Clause
// Costmap and planner together, as the navigator has them: whatever people, map and request look like, there
// is one outcome, and a trajectory that ends standing.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lattice_planner/lattice_planner.h"
#include "social_costmap/timed_costmap.h"

namespace sarn_navigation {
namespace {

using lattice_planner::PlanStatus;
using social_costmap::PredictionStatus;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kNow = 100.0;  // [s]

sarn::PersonPrediction walker(const std::string& name, const Eigen::Vector2d& from,
                              const Eigen::Vector2d& velocity, int steps = 20) {
  sarn::PersonPrediction person{name, "", {}};
  for (int i = 0; i < steps; ++i) person.states.push_back({from + 0.5 * i * velocity, velocity, 0.05 * i});
  return person;
}

/// A free hall with a lethal cell and a patch of unknown space.
sarn::OccupancyMap hall(double width = 6.0, double height = 4.0, double resolution = 0.05) {
  sarn::OccupancyMap map;
  map.geometry = {static_cast<int>(std::lround(width / resolution)),
                  static_cast<int>(std::lround(height / resolution)), resolution, 0.0, 0.0};
  map.cells.assign(map.geometry.size(), sarn::kMapFree);
  map.cells[map.geometry.index(*map.geometry.cellAt(3.0, 3.7))] = sarn::kMapOccupied;
  for (double y = 0.02; y < 0.4; y += resolution) {
    for (double x = 5.02; x < 5.5; x += resolution)
      map.cells[map.geometry.index(*map.geometry.cellAt(x, y))] = sarn::kMapUnknown;
  }
  return map;
}

class RobustnessTest : public testing::Test {
 protected:
  RobustnessTest() : costmap_(social_costmap::CostmapParams{}), planner_(params()) {
    costmap_.setMap(hall());
  }

  static lattice_planner::PlannerParams params() {
    lattice_planner::PlannerParams params;
    params.table_radius = 0.4;
    params.max_expansions = 30000;
    return params;
  }

  lattice_planner::PlanResult plan(const sarn::Pose2D& start = {1.0, 2.0, 0.0},
                                   const sarn::Pose2D& goal = {5.0, 2.0, 0.0}) {
    const auto snapshot = costmap_.update({start.x, start.y, start.theta}, kNow);
    report_ = snapshot->social;
    const auto result =
        planner_.plan({{start.x, start.y, start.theta, 0.0, 0.0, kNow}, goal, 60.0}, snapshot->view());
    for (const auto& p : result.trajectory.points) {
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.theta) && std::isfinite(p.t));
    }
    if (!result.trajectory.empty()) {
      EXPECT_EQ(result.trajectory.points.back().v, 0.0);
      EXPECT_EQ(result.trajectory.points.back().omega, 0.0);
    }
    return result;
  }
  lattice_planner::PlanResult planAmong(std::vector<sarn::PersonPrediction> people) {
    costmap_.setPrediction({kNow, 0.5, std::move(people)});
    return plan();
  }

  social_costmap::TimedCostmap costmap_;
  lattice_planner::LatticePlanner planner_;
  social_costmap::SocialReport report_;
};

TEST_F(RobustnessTest, peopleOutsideTheMapAreNoMatter) {
  const double alone = plan().cost;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(-30.0, 2.0), {2.0, -30.0}, {60.0, 2.0}, {2.0, 60.0}}) {
    const auto result = planAmong({walker("anna", at, {0.1, 0.0})});
    EXPECT_EQ(result.status, PlanStatus::kComplete) << at.transpose();
    EXPECT_DOUBLE_EQ(result.cost, alone) << at.transpose();
    EXPECT_EQ(report_.people, 1);
  }
}

TEST_F(RobustnessTest, peopleWhoAreNotFiniteAreIgnoredAndCounted) {
  const double alone = plan().cost;
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1e300}) {
    const auto result = planAmong({walker("anna", {bad, 2.0}, {0.0, 0.0})});
    EXPECT_EQ(result.status, PlanStatus::kComplete) << bad;
    EXPECT_DOUBLE_EQ(result.cost, alone) << bad;
    EXPECT_EQ(report_.ignored_people, 1) << bad;
  }
}

TEST_F(RobustnessTest, twoHundredPeopleGetOnePlan) {
  std::vector<sarn::PersonPrediction> people;
  for (int i = 0; i < 200; ++i) {
    people.push_back(
        walker("p" + std::to_string(i), {0.03 * i, 0.5 + 3.0 * (i % 2)}, {0.2, i % 2 == 0 ? -0.1 : 0.1}));
  }
  EXPECT_EQ(planAmong(people).status, PlanStatus::kComplete);
  EXPECT_EQ(report_.people, 200);
}

TEST_F(RobustnessTest, orderAndNamesOfPeopleChangeNothing) {
  const auto a = walker("anna", {3.0, 3.0}, {0.0, -0.5});
  const auto b = walker("ben", {3.5, 1.0}, {0.0, 0.4});
  auto twin = b;
  twin.name = "anna";  // twice the same name
  const auto in_order = planAmong({a, b});
  const auto turned_round = planAmong({b, a});
  const auto of_one_name = planAmong({a, twin});
  ASSERT_EQ(in_order.status, PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(in_order.cost, turned_round.cost);
  EXPECT_DOUBLE_EQ(in_order.cost, of_one_name.cost);
}

TEST_F(RobustnessTest, peopleMayBePredictedForDifferentTimes) {
  const auto result =
      planAmong({walker("anna", {3.0, 3.0}, {0.0, -0.5}, 20), walker("ben", {3.5, 1.0}, {0.0, 0.4}, 3),
                 walker("nobody", {0.0, 0.0}, {0.0, 0.0}, 0)});
  EXPECT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_GE(report_.people, 2);
}

TEST_F(RobustnessTest, predictionsWithoutATimeStepShowNobody) {
  const double alone = plan().cost;
  for (const double step : {0.0, -0.5, kNan}) {
    costmap_.setPrediction({kNow, step, {walker("anna", {3.0, 2.0}, {0.0, 0.0})}});
    const auto result = plan();
    EXPECT_EQ(result.status, PlanStatus::kComplete) << step;
    EXPECT_DOUBLE_EQ(result.cost, alone) << step;
    EXPECT_NE(report_.status, PredictionStatus::kUsed) << step;
  }
}

TEST_F(RobustnessTest, mapsMayChangeTheirSizeBetweenPlans) {
  costmap_.setPrediction({kNow, 0.5, {walker("anna", {3.0, 3.0}, {0.0, -0.5})}});
  for (const double width : {6.0, 9.0, 5.6, 7.0}) {
    for (const double resolution : {0.05, 0.1}) {
      costmap_.setMap(hall(width, 4.0, resolution));
      EXPECT_EQ(plan().status, PlanStatus::kComplete) << width << " m, cells of " << resolution << " m";
    }
  }
  costmap_.setMap(hall(5.6, 4.0));
  EXPECT_EQ(plan({1.0, 2.0, 0.0}, {8.0, 2.0, 0.0}).status, PlanStatus::kGoalOutsideMap);
  EXPECT_EQ(plan({8.0, 2.0, 0.0}, {1.0, 2.0, 0.0}).status, PlanStatus::kStartOutsideMap);
}

TEST_F(RobustnessTest, placesThatCannotBeAreNamed) {
  const sarn::Pose2D free{1.0, 2.0, 0.0};
  EXPECT_EQ(plan(free, {5.25, 0.2, 0.0}).status, PlanStatus::kGoalUnknown);
  EXPECT_EQ(plan(free, {3.0, 3.7, 0.0}).status, PlanStatus::kGoalOccupied) << "an obstacle";
  EXPECT_EQ(plan({3.02, 3.72, 0.0}, free).status, PlanStatus::kStartOccupied);
  EXPECT_EQ(plan({3.0, 3.55, 0.0}, free).status, PlanStatus::kComplete)
      << "too near to an obstacle: it may leave";
  EXPECT_EQ(plan(free, {kNan, 2.0, 0.0}).status, PlanStatus::kInvalidRequest);
}

}  // namespace
}  // namespace sarn_navigation
