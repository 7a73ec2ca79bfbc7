// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ompl/robot_space.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/TimeStateSpace.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "lattice_planner/trajectory_cost.h"
#include "sarn_common/angles.h"

namespace lattice_planner_ompl {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

using Compound = ob::CompoundStateSpace::StateType;
using Pose = ob::SE2StateSpace::StateType;
using Speeds = ob::RealVectorStateSpace::StateType;
using Time = ob::TimeStateSpace::StateType;

double approach(double value, double step) {
  return value > 0.0 ? std::max(0.0, value - step) : std::min(0.0, value + step);
}

ob::StateSpacePtr makeSpace(const Problem& problem, double start_time) {
  const lattice_planner::PlannerParams& params = problem.params;
  const sarn::GridGeometry& grid = problem.costs.geometry;
  auto pose = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds map(2);
  map.setLow(0, grid.origin_x);
  map.setLow(1, grid.origin_y);
  map.setHigh(0, grid.origin_x + grid.width * grid.resolution);
  map.setHigh(1, grid.origin_y + grid.height * grid.resolution);
  pose->setBounds(map);
  auto speeds = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds limits(2);
  limits.setLow(0, params.min_vel_x);
  limits.setHigh(0, params.max_vel_x);
  limits.setLow(1, -params.max_vel_theta);
  limits.setHigh(1, params.max_vel_theta);
  speeds->setBounds(limits);
  auto time = std::make_shared<ob::TimeStateSpace>();
  time->setBounds(start_time, start_time + problem.longest);
  auto space = std::make_shared<ob::CompoundStateSpace>();
  space->addSubspace(pose, 1.0);
  space->addSubspace(speeds, 0.3);
  space->addSubspace(time, 0.01);  // how near two states are is hardly a matter of time
  space->lock();
  return space;
}

}  // namespace

sarn::TrajectoryPoint pointOf(const ob::State* state) {
  const auto* all = state->as<Compound>();
  const auto* pose = all->as<Pose>(0);
  const auto* speeds = all->as<Speeds>(1);
  return {pose->getX(),      pose->getY(),      pose->getYaw(),
          speeds->values[0], speeds->values[1], all->as<Time>(2)->position};
}

void setState(ob::State* state, const sarn::TrajectoryPoint& point) {
  auto* all = state->as<Compound>();
  all->as<Pose>(0)->setXY(point.x, point.y);
  all->as<Pose>(0)->setYaw(sarn::wrapAngle(point.theta));
  all->as<Speeds>(1)->values[0] = point.v;
  all->as<Speeds>(1)->values[1] = point.omega;
  all->as<Time>(2)->position = point.t;
}

sarn::TrajectoryPoint stepped(const sarn::TrajectoryPoint& from, double acceleration,
                              double angular_acceleration, double dt) {
  const double v = from.v + acceleration * dt;
  const double omega = from.omega + angular_acceleration * dt;
  const sarn::Pose2D pose = sarn::advance(from.pose(), {0.5 * (from.v + v), 0.5 * (from.omega + omega)}, dt);
  return {pose.x, pose.y, pose.theta, v, omega, from.t + dt};
}

double stepDuration(const lattice_planner::PlannerParams& params) {
  const double fastest = std::max(params.max_vel_x, -params.min_vel_x);
  return params.time_step / std::ceil(fastest * params.time_step / params.collision_check_distance - 1e-9);
}

Problem makeProblem(const lattice_planner::PlannerParams& params, const sarn::TimedCostmapView& costs) {
  Problem problem{params, costs};
  const auto footprint = lattice_planner::parseFootprint(params.footprint);
  const bool usable = costs.static_costs != nullptr && costs.geometry.resolution > 0.0;
  if (footprint.round() || !usable) return problem;
  problem.footprint = std::make_shared<lattice_planner::FootprintCheck>(footprint, params.allow_unknown);
  problem.footprint->reset(costs);
  return problem;
}

bool isFree(const Problem& problem, const sarn::TrajectoryPoint& point) {
  const auto cell = problem.costs.geometry.cellAt(point.x, point.y);
  if (!cell) return false;
  const std::size_t i = problem.costs.geometry.index(*cell);
  const auto allowed = [&](std::uint8_t cost) {
    if (cost == sarn::kNoInformation) return problem.params.allow_unknown;
    return cost < problem.params.forbidden_cost;
  };
  if (!allowed(problem.costs.static_costs[i])) return false;
  const int layer = problem.costs.layerAt(point.t);
  if (layer >= 0 && !allowed(problem.costs.layers[static_cast<std::size_t>(layer)][i])) return false;
  return !problem.footprint || (problem.footprint->clearOfStatic(point.pose()) &&
                                problem.footprint->clearOfPeople(point.pose(), layer));
}

oc::SpaceInformationPtr makeSpaceInformation(const Problem& problem, double start_time) {
  const ob::StateSpacePtr space = makeSpace(problem, start_time);
  auto controls = std::make_shared<oc::RealVectorControlSpace>(space, 2);
  ob::RealVectorBounds limits(2);
  limits.setLow(0, -problem.params.acc_lim_x);
  limits.setHigh(0, problem.params.acc_lim_x);
  limits.setLow(1, -problem.params.acc_lim_theta);
  limits.setHigh(1, problem.params.acc_lim_theta);
  controls->setBounds(limits);
  auto si = std::make_shared<oc::SpaceInformation>(space, controls);
  si->setStatePropagator(
      [](const ob::State* from, const oc::Control* control, double duration, ob::State* to) {
        const double* a = control->as<oc::RealVectorControlSpace::ControlType>()->values;
        setState(to, stepped(pointOf(from), a[0], a[1], duration));
      });
  si->setStateValidityChecker([&problem, raw = si.get()](const ob::State* state) {
    return raw->satisfiesBounds(state) && isFree(problem, pointOf(state));
  });
  const double step = stepDuration(problem.params);
  si->setPropagationStepSize(step);
  si->setMinMaxControlDuration(1, static_cast<unsigned>(std::lround(1.0 / step)));
  si->setup();
  return si;
}

CostObjective::CostObjective(const ob::SpaceInformationPtr& si, const Problem& problem)
    : ob::OptimizationObjective(si), problem_(problem) {
  description_ = "time, way, turning and the cells' costs";
}

ob::Cost CostObjective::stateCost(const ob::State*) const { return identityCost(); }

ob::Cost CostObjective::motionCost(const ob::State* from, const ob::State* to) const {
  const sarn::TrajectoryPoint a = pointOf(from);
  const sarn::TrajectoryPoint b = pointOf(to);
  const double duration = b.t - a.t;
  if (!(duration > 0.0)) return identityCost();
  const int steps = std::max(1, static_cast<int>(std::lround(duration / stepDuration(problem_.params))));
  sarn::TimedTrajectory way;
  way.points.push_back(a);
  for (int i = 0; i < steps; ++i) {
    way.points.push_back(
        stepped(way.points.back(), (b.v - a.v) / duration, (b.omega - a.omega) / duration, duration / steps));
  }
  return ob::Cost(lattice_planner::trajectoryCost(problem_.params, way, problem_.costs, a.t));
}

std::vector<sarn::TrajectoryPoint> brake(const Problem& problem, const sarn::TrajectoryPoint& from) {
  const double dt = stepDuration(problem.params);
  std::vector<sarn::TrajectoryPoint> points;
  sarn::TrajectoryPoint point = from;
  while (point.v != 0.0 || point.omega != 0.0) {
    const double v = approach(point.v, problem.params.acc_lim_x * dt);
    const double omega = approach(point.omega, problem.params.acc_lim_theta * dt);
    point = stepped(point, (v - point.v) / dt, (omega - point.omega) / dt, dt);
    point.v = v;  // exactly 0 in the end
    point.omega = omega;
    points.push_back(point);
  }
  return points;
}

BrakingGoal::BrakingGoal(const ob::SpaceInformationPtr& si, const Problem& problem, const sarn::Pose2D& goal)
    : ob::GoalRegion(si), problem_(problem), goal_(goal) {
  threshold_ = 1e-9;
}

double BrakingGoal::distanceGoal(const ob::State* state) const {
  const double distance = distanceFrom(pointOf(state));
  if (distance <= threshold_ && !first_reached_) first_reached_ = std::chrono::steady_clock::now();
  return distance;
}

double BrakingGoal::distanceFrom(const sarn::TrajectoryPoint& point) const {
  const auto braking = brake(problem_, point);
  const sarn::TrajectoryPoint& end = braking.empty() ? point : braking.back();
  const double away = (end.pose().position() - goal_.position()).norm() - problem_.params.xy_goal_tolerance;
  const double turned =
      std::abs(sarn::angleDifference(end.theta, goal_.theta)) - problem_.params.yaw_goal_tolerance;
  const double distance = std::max(0.0, away) + 0.2 * std::max(0.0, turned);
  if (distance > 0.0) return distance;
  const bool blocked =
      std::any_of(braking.begin(), braking.end(), [this](const auto& p) { return !isFree(problem_, p); });
  return blocked ? 1e-3 : 0.0;
}

}  // namespace lattice_planner_ompl
