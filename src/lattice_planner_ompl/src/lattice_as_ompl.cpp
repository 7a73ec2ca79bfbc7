// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ompl/lattice_as_ompl.h"

#include <ompl/control/PathControl.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <memory>
#include <string>

namespace lattice_planner_ompl {

namespace ob = ompl::base;
namespace oc = ompl::control;

LatticeAsOmpl::LatticeAsOmpl(const ob::SpaceInformationPtr& si, const Problem& problem)
    : ob::Planner(si, "lattice"), problem_(problem), planner_(problem.params) {
  specs_.approximateSolutions = true;
  specs_.optimizingPaths = true;
  specs_.directed = true;
  declareParam<double>("time_limit", this, &LatticeAsOmpl::setTimeLimit, &LatticeAsOmpl::timeLimit,
                       "0.01:60");
}

void LatticeAsOmpl::clear() {
  ob::Planner::clear();
  first_solution_time_ = 0.0;
}

/// The lattice's states are not OMPL's: there is no roadmap to show, only how it went.
void LatticeAsOmpl::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  data.properties["first solution time REAL"] = std::to_string(first_solution_time_);
}

ob::PlannerStatus LatticeAsOmpl::solve(const ob::PlannerTerminationCondition& condition) {
  checkValidity();
  first_solution_time_ = 0.0;
  const auto* goal = dynamic_cast<const BrakingGoal*>(pdef_->getGoal().get());
  if (goal == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  const ob::State* start = pis_.nextStart();
  if (start == nullptr) return ob::PlannerStatus::INVALID_START;
  if (condition) return ob::PlannerStatus::TIMEOUT;
  const auto result = planner_.plan(
      {pointOf(start), goal->pose(), time_limit_, [&condition] { return condition(); }}, problem_.costs);
  first_solution_time_ = result.first_plan_time;
  if (!lattice_planner::isDrivable(result.status)) return ob::PlannerStatus::TIMEOUT;
  auto path = std::make_shared<oc::PathControl>(si_);
  const auto* si = static_cast<const oc::SpaceInformation*>(si_.get());
  oc::Control* control = si->allocControl();
  ob::State* state = si_->allocState();
  const auto& points = result.trajectory.points;
  setState(state, points.front());
  path->append(state);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double dt = points[i].t - points[i - 1].t;
    double* a = control->as<oc::RealVectorControlSpace::ControlType>()->values;
    a[0] = (points[i].v - points[i - 1].v) / dt;
    a[1] = (points[i].omega - points[i - 1].omega) / dt;
    setState(state, points[i]);
    path->append(state, control, dt);
  }
  si_->freeState(state);
  si->freeControl(control);
  const bool complete = result.status == lattice_planner::PlanStatus::kComplete;
  ob::PlannerSolution solution(path);
  solution.setPlannerName(getName());
  solution.setOptimized(pdef_->getOptimizationObjective(), ob::Cost(result.cost), complete);
  if (!complete) solution.setApproximate(goal->distanceGoal(path->getStates().back()));
  pdef_->addSolutionPath(solution);
  return complete ? ob::PlannerStatus::EXACT_SOLUTION : ob::PlannerStatus::APPROXIMATE_SOLUTION;
}

}  // namespace lattice_planner_ompl
