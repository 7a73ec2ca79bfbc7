// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ompl/ompl_planner.h"

#include <gtest/gtest.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/PathControl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "lattice_planner/trajectory_cost.h"
#include "lattice_planner_ompl/lattice_as_ompl.h"
#include "sarn_common/angles.h"

namespace lattice_planner_ompl {
namespace {

using lattice_planner::PlanStatus;

/// A hall of 6 x 4 m; a person's disc stands in it from 4 s on.
class OmplTest : public testing::Test {
 protected:
  OmplTest() : walls_({60, 40, 0.1, 0.0, 0.0}, 0), empty_(walls_), person_(walls_) {
    for (int y = 15; y < 25; ++y) {
      for (int x = 25; x < 35; ++x) person_.at({x, y}) = 254;
    }
    problem_.params.table_radius = 0.0;
    problem_.costs.geometry = walls_.geometry;
    problem_.costs.static_costs = walls_.cells.data();
    problem_.costs.layers = {empty_.cells.data(), person_.cells.data()};
    problem_.costs.layer_duration = 4.0;
  }
  lattice_planner::PlanRequest request(double limit) const {
    return {{1.0, 2.0, 0.0, 0.0, 0.0, 0.0}, {5.0, 2.0, 0.0}, limit};
  }
  /// The request in OMPL's words.
  ompl::base::ProblemDefinitionPtr define(const ompl::control::SpaceInformationPtr& si) const {
    auto definition = std::make_shared<ompl::base::ProblemDefinition>(si);
    ompl::base::ScopedState<> start(si);
    setState(start.get(), request(1.0).start);
    definition->addStartState(start);
    definition->setGoal(std::make_shared<BrakingGoal>(si, problem_, request(1.0).goal));
    definition->setOptimizationObjective(std::make_shared<CostObjective>(si, problem_));
    return definition;
  }
  /// Ends standing in the goal, within the limits and nowhere forbidden at its time.
  void expectSound(const sarn::TimedTrajectory& trajectory, const sarn::Pose2D& goal) {
    const auto& points = trajectory.points;
    ASSERT_GT(points.size(), 5U);
    EXPECT_EQ(points.back().v, 0.0);
    EXPECT_EQ(points.back().omega, 0.0);
    EXPECT_LE((points.back().pose().position() - goal.position()).norm(),
              problem_.params.xy_goal_tolerance + 1e-6);
    EXPECT_LE(std::abs(sarn::angleDifference(points.back().theta, goal.theta)),
              problem_.params.yaw_goal_tolerance + 1e-6);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(isFree(problem_, points[i])) << i;
      EXPECT_LE(points[i].v, problem_.params.max_vel_x + 1e-6) << i;
      EXPECT_GE(points[i].v, problem_.params.min_vel_x - 1e-6) << i;
      EXPECT_LE(std::abs(points[i].omega), problem_.params.max_vel_theta + 1e-6) << i;
      if (i == 0) continue;
      const double dt = points[i].t - points[i - 1].t;
      ASSERT_GT(dt, 0.0) << i;
      EXPECT_LE(std::abs(points[i].v - points[i - 1].v), problem_.params.acc_lim_x * dt + 1e-6) << i;
      const sarn::Pose2D reached = trajectory.sample(points[i].t - 1e-9).pose();
      EXPECT_LT((reached.position() - points[i].pose().position()).norm(), 1e-3) << i;
    }
  }

  sarn::Grid<std::uint8_t> walls_;
  sarn::Grid<std::uint8_t> empty_;
  sarn::Grid<std::uint8_t> person_;
  Problem problem_;
};

TEST_F(OmplTest, eachAlgorithmDrivesToTheGoalAndStops) {
  int solved = 0;
  for (const auto algorithm : {OmplAlgorithm::kSst, OmplAlgorithm::kRrt, OmplAlgorithm::kKpiece}) {
    OmplPlanner planner(algorithm, problem_.params);
    const auto outcome =
        planner.planMeasured(request(algorithm == OmplAlgorithm::kSst ? 2.0 : 10.0), problem_.costs);
    if (outcome.result.status == PlanStatus::kPartial) continue;  // random: the time may be too short
    ASSERT_EQ(outcome.result.status, PlanStatus::kComplete) << static_cast<int>(algorithm);
    EXPECT_GT(outcome.first_solution_time, 0.0);
    EXPECT_LT(outcome.first_solution_time, outcome.result.search_time);
    expectSound(outcome.result.trajectory, request(1.0).goal);
    ++solved;
  }
  EXPECT_GT(solved, 0);
}

TEST_F(OmplTest, refusesWhatTheLatticePlannerRefuses) {
  OmplPlanner planner(OmplAlgorithm::kRrt, problem_.params);
  auto bad = request(0.1);
  bad.goal.x = 50.0;
  EXPECT_EQ(planner.plan(bad, problem_.costs).status, PlanStatus::kGoalOutsideMap);
  bad.goal.x = std::nan("");
  EXPECT_EQ(planner.plan(bad, problem_.costs).status, PlanStatus::kInvalidRequest);
  bad = request(0.1);
  walls_.at({50, 20}) = 254;
  EXPECT_EQ(planner.plan(bad, problem_.costs).status, PlanStatus::kGoalOccupied);
  walls_.at({50, 20}) = 255;
  EXPECT_EQ(planner.plan(bad, problem_.costs).status, PlanStatus::kGoalUnknown);
  walls_.at({10, 20}) = 254;
  EXPECT_EQ(planner.plan(bad, problem_.costs).status, PlanStatus::kStartOccupied);
  EXPECT_THROW((void)algorithmOf("prm"), std::invalid_argument);
}

TEST_F(OmplTest, latticeIsAPlannerOfOmpl) {
  namespace ob = ompl::base;
  const auto si = makeSpaceInformation(problem_, -1e-6);
  const auto definition = define(si);
  LatticeAsOmpl planner(si, problem_);
  planner.setProblemDefinition(definition);
  planner.params().setParam("time_limit", "5");
  planner.setup();
  EXPECT_EQ(ob::PlannerStatus::EXACT_SOLUTION, planner.solve(ob::plannerNonTerminatingCondition()));
  auto path = *definition->getSolutionPath()->as<ompl::control::PathControl>();
  EXPECT_TRUE(definition->getGoal()->isSatisfied(path.getStates().back()));
  // An action of the lattice is one arc of the mean speeds, OMPL's propagation a few: they end near each
  // other.
  const auto* controls = static_cast<const ompl::control::SpaceInformation*>(si.get());
  ob::ScopedState<> end(si);
  for (unsigned i = 0; i + 1 < path.getStateCount(); ++i) {
    EXPECT_TRUE(si->isValid(path.getState(i))) << i;
    const int steps =
        static_cast<int>(std::lround(path.getControlDuration(i) / stepDuration(problem_.params)));
    controls->propagate(path.getState(i), path.getControl(i), steps, end.get());
    const sarn::TrajectoryPoint a = pointOf(end.get());
    const sarn::TrajectoryPoint b = pointOf(path.getState(i + 1));
    EXPECT_LT((a.pose().position() - b.pose().position()).norm(), 0.01) << i;
    EXPECT_NEAR(a.v, b.v, 1e-9) << i;
    EXPECT_NEAR(a.t, b.t, 1e-9) << i;
  }
}

TEST_F(OmplTest, latticeObeysOmplsTerminationCondition) {
  namespace ob = ompl::base;
  const auto si = makeSpaceInformation(problem_, -1e-6);
  const auto solve = [&](const ob::PlannerTerminationCondition& condition, LatticeAsOmpl& planner) {
    planner.setProblemDefinition(define(si));
    planner.setup();
    return planner.solve(condition);
  };
  LatticeAsOmpl planner(si, problem_);
  int asked = 0;  // once before the search: this one ends it before its first expansion
  EXPECT_NE(ob::PlannerStatus::EXACT_SOLUTION,
            solve(ob::PlannerTerminationCondition([&asked] { return ++asked > 1; }), planner));
  EXPECT_GT(asked, 1);
  EXPECT_EQ(planner.firstSolutionTime(), 0.0);
  EXPECT_EQ(ob::PlannerStatus::EXACT_SOLUTION, solve(ob::plannerNonTerminatingCondition(), planner));
}

TEST_F(OmplTest, latticeTellsOmplWhenItsFirstSolutionWasThere) {
  namespace ob = ompl::base;
  const auto si = makeSpaceInformation(problem_, -1e-6);
  LatticeAsOmpl planner(si, problem_);
  planner.setProblemDefinition(define(si));
  planner.setup();
  ASSERT_EQ(ob::PlannerStatus::EXACT_SOLUTION, planner.solve(ob::plannerNonTerminatingCondition()));
  EXPECT_GT(planner.firstSolutionTime(), 0.0);
  ob::PlannerData data(si);
  planner.getPlannerData(data);
  EXPECT_GT(std::stod(data.properties.at("first solution time REAL")), 0.0);
  planner.clear();
  EXPECT_EQ(planner.firstSolutionTime(), 0.0);
}

TEST_F(OmplTest, costOfAMotionIsThePlannersOwn) {
  const auto si = makeSpaceInformation(problem_, -1e-6);
  const CostObjective objective(si, problem_);
  for (auto& cell : walls_.cells) cell = 126;
  ompl::base::ScopedState<> a(si);
  ompl::base::ScopedState<> b(si);
  const sarn::TrajectoryPoint from{1.0, 2.0, 0.3, 0.2, 0.1, 0.0};
  setState(a.get(), from);
  sarn::TrajectoryPoint to = from;
  sarn::TimedTrajectory way;
  way.points.push_back(from);
  const double dt = stepDuration(problem_.params);
  for (int i = 0; i < 4; ++i) {
    to = stepped(to, 0.5, -0.4, dt);
    way.points.push_back(to);
  }
  setState(b.get(), to);
  EXPECT_NEAR(objective.motionCost(a.get(), b.get()).value(),
              lattice_planner::trajectoryCost(problem_.params, way, problem_.costs, 0.0), 1e-6);
  EXPECT_GT(objective.motionCost(a.get(), b.get()).value(), 4 * dt * problem_.params.time_weight);
}

TEST_F(OmplTest, outlineOfTheRobotIsLookedAtToo) {
  walls_.at(*walls_.geometry.cellAt(1.4, 2.0)) = 254;
  EXPECT_TRUE(isFree(problem_, {1.0, 2.0, 0.0, 0.0, 0.0, 1.0}));
  lattice_planner::PlannerParams params = problem_.params;
  params.footprint = "[[0.5, 0.2], [-0.5, 0.2], [-0.5, -0.2], [0.5, -0.2]]";
  const Problem problem = makeProblem(params, problem_.costs);
  EXPECT_FALSE(isFree(problem, {1.0, 2.0, 0.0, 0.0, 0.0, 1.0})) << "its nose";
  EXPECT_TRUE(isFree(problem, {1.0, 2.0, 1.57, 0.0, 0.0, 1.0}));
}

TEST_F(OmplTest, goalRemembersWhenItWasFirstReached) {
  const auto si = makeSpaceInformation(problem_, -1e-6);
  const BrakingGoal goal(si, problem_, request(1.0).goal);
  ompl::base::ScopedState<> state(si);
  setState(state.get(), request(1.0).start);
  EXPECT_GT(goal.distanceGoal(state.get()), 0.0);
  EXPECT_FALSE(goal.firstReached());
  setState(state.get(), {5.0, 2.0, 0.0, 0.0, 0.0, 3.0});
  EXPECT_EQ(goal.distanceGoal(state.get()), 0.0);
  ASSERT_TRUE(goal.firstReached());
  const auto first = *goal.firstReached();
  EXPECT_TRUE(goal.isSatisfied(state.get()));
  EXPECT_EQ(*goal.firstReached(), first);
}

TEST_F(OmplTest, peopleForbidAPlaceOnlyAtTheirTime) {
  EXPECT_TRUE(isFree(problem_, {3.0, 2.0, 0.0, 0.0, 0.0, 1.0}));
  EXPECT_FALSE(isFree(problem_, {3.0, 2.0, 0.0, 0.0, 0.0, 5.0}));
}

}  // namespace
}  // namespace lattice_planner_ompl
