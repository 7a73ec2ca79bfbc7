// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ompl/ompl_planner.h"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/control/PathControl.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "lattice_planner/trajectory_cost.h"
#include "lattice_planner_ompl/make_planner.h"
#include "lattice_planner_ompl/robot_space.h"

namespace lattice_planner_ompl {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
using lattice_planner::PlanResult;
using lattice_planner::PlanStatus;
using Clock = std::chrono::steady_clock;

constexpr double kLeastProgress = 0.1;  // [m] a partial plan must come this much closer to the goal

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// The path's states at each step of propagation.
sarn::TimedTrajectory trajectoryOf(oc::PathControl path) {
  path.interpolate();
  sarn::TimedTrajectory trajectory;
  for (const ob::State* state : path.getStates()) {
    const sarn::TrajectoryPoint point = pointOf(state);
    if (trajectory.empty() || point.t > trajectory.endTime() + 1e-9) trajectory.points.push_back(point);
  }
  return trajectory;
}

/// Ends the trajectory standing still: brakes at its end or, where that is blocked, as late as it can before.
void endStanding(const Problem& problem, sarn::TimedTrajectory& trajectory) {
  while (!trajectory.empty()) {
    const auto braking = brake(problem, trajectory.points.back());
    const bool free = std::all_of(braking.begin(), braking.end(),
                                  [&](const sarn::TrajectoryPoint& p) { return isFree(problem, p); });
    if (free || trajectory.points.size() == 1) {
      trajectory.points.insert(trajectory.points.end(), braking.begin(), braking.end());
      return;
    }
    trajectory.points.pop_back();
  }
}

PlanStatus refuse(const lattice_planner::PlanRequest& request, const Problem& problem) {
  const sarn::TrajectoryPoint& s = request.start;
  const sarn::Pose2D& g = request.goal;
  const bool finite = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.theta) &&
                      std::isfinite(s.v) && std::isfinite(s.omega) && std::isfinite(s.t) &&
                      std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.theta);
  if (!finite || !(request.time_limit > 0.0) || problem.costs.static_costs == nullptr)
    return PlanStatus::kInvalidRequest;
  if (!problem.costs.geometry.cellAt(s.x, s.y)) return PlanStatus::kStartOutsideMap;
  if (!problem.costs.geometry.cellAt(g.x, g.y)) return PlanStatus::kGoalOutsideMap;
  if (!isFree(problem, s)) return PlanStatus::kStartOccupied;
  Problem alone = problem;
  alone.costs.layers.clear();
  if (isFree(alone, {g.x, g.y, g.theta, 0.0, 0.0, s.t})) return PlanStatus::kComplete;
  const auto goal = problem.costs.geometry.index(*problem.costs.geometry.cellAt(g.x, g.y));
  return problem.costs.static_costs[goal] == sarn::kNoInformation ? PlanStatus::kGoalUnknown
                                                                  : PlanStatus::kGoalOccupied;
}

}  // namespace

OmplPlanner::OmplPlanner(OmplAlgorithm algorithm, const lattice_planner::PlannerParams& params,
                         std::uint32_t seed)
    : algorithm_(algorithm), params_(params) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  static std::once_flag seeded;  // OMPL takes one seed a process
  std::call_once(seeded, [seed] { ompl::RNG::setSeed(seed); });
}

PlanResult OmplPlanner::plan(const lattice_planner::PlanRequest& request,
                             const sarn::TimedCostmapView& costs) {
  return planMeasured(request, costs).result;
}

OmplOutcome OmplPlanner::planMeasured(const lattice_planner::PlanRequest& request,
                                      const sarn::TimedCostmapView& costs) {
  const Clock::time_point begin = Clock::now();
  OmplOutcome outcome;
  PlanResult& result = outcome.result;
  const Problem problem = makeProblem(params_, costs);
  result.status = refuse(request, problem);
  if (result.status != PlanStatus::kComplete) return outcome;

  const oc::SpaceInformationPtr si = makeSpaceInformation(problem, request.start.t - 1e-6);
  auto definition = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<> start(si);
  setState(start.get(), request.start);
  si->enforceBounds(start.get());
  definition->addStartState(start);
  const auto goal = std::make_shared<BrakingGoal>(si, problem, request.goal);
  definition->setGoal(goal);
  definition->setOptimizationObjective(std::make_shared<CostObjective>(si, problem));
  const ob::PlannerPtr planner = makePlanner(algorithm_, si);
  planner->setProblemDefinition(definition);
  planner->setup();

  const auto out_of_time =
      ob::PlannerTerminationCondition([&] { return since(begin) >= request.time_limit; });
  const auto first = ob::plannerOrTerminationCondition(
      out_of_time, ob::PlannerTerminationCondition([&] { return definition->hasExactSolution(); }));
  (void)planner->solve(first);
  if (definition->hasExactSolution() && goal->firstReached()) {
    outcome.first_solution_time = std::chrono::duration<double>(*goal->firstReached() - begin).count();
  }
  const bool improves = algorithm_ == OmplAlgorithm::kSst;
  if (improves && definition->hasExactSolution() && !out_of_time) (void)planner->solve(out_of_time);

  result.search_time = since(begin);
  result.timed_out = !definition->hasExactSolution();
  if (!definition->hasSolution()) {
    result.status = PlanStatus::kNoPath;
    return outcome;
  }
  result.trajectory = trajectoryOf(*definition->getSolutionPath()->as<oc::PathControl>());
  endStanding(problem, result.trajectory);
  result.cost = lattice_planner::trajectoryCost(params_, result.trajectory, costs, request.start.t);
  if (definition->hasExactSolution()) return outcome;
  const auto distance = [&](const sarn::TrajectoryPoint& p) {
    return (p.pose().position() - request.goal.position()).norm();
  };
  const bool closer = distance(result.trajectory.points.back()) < distance(request.start) - kLeastProgress;
  result.status = closer ? PlanStatus::kPartial : PlanStatus::kNoPath;
  return outcome;
}

}  // namespace lattice_planner_ompl
