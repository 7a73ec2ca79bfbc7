// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/plan_continuation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lattice_planner/commit.h"
#include "lattice_planner/trajectory_cost.h"
#include "sarn_common/angles.h"
#include "sarn_navigation/plan_conflict.h"

namespace sarn_move_base {
namespace {

using lattice_planner::PlanResult;
using lattice_planner::PlanStatus;

constexpr double kSameGoal = 1e-6;  // [m], [rad]

const ContinuationParams& checked(const ContinuationParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("plan continuation: " + text);
  return params;
}

bool goalIsTaken(PlanStatus status) {
  return status == PlanStatus::kGoalOccupied || status == PlanStatus::kGoalUnknown;
}

bool same(const sarn::Pose2D& a, const sarn::Pose2D& b) {
  return (a.position() - b.position()).norm() < kSameGoal &&
         std::abs(sarn::angleDifference(a.theta, b.theta)) < kSameGoal;
}

}  // namespace

PlanContinuation::PlanContinuation(const lattice_planner::PlannerParams& planner,
                                   const ContinuationParams& params)
    : params_(checked(params)),
      body_(planner.footprint),
      planner_(planner),
      footprint_(lattice_planner::parseFootprint(planner.footprint), planner.allow_unknown) {}

void PlanContinuation::setWeights(const lattice_planner::PlannerParams& params) {
  lattice_planner::PlannerParams wanted = params;
  const std::lock_guard<std::mutex> lock(settings_mutex_);
  wanted.footprint = body_;
  planner_.setParams(wanted);
}

void PlanContinuation::setFootprint(const lattice_planner::Footprint& footprint) {
  const lattice_planner::PlannerParams params = [&] {
    const std::lock_guard<std::mutex> lock(settings_mutex_);
    lattice_planner::PlannerParams wanted = planner_.params();
    wanted.footprint = body_ = lattice_planner::toString(footprint);
    planner_.setParams(wanted);
    return wanted;
  }();
  footprint_ = lattice_planner::FootprintCheck(footprint, params.allow_unknown);
  planner_.waitUntilReady();
}

/// The robot is where the last plan has it, and what it will do while the search runs is still free.
bool PlanContinuation::isDriven(const ContinuationRequest& request, const sarn::TimedCostmapView& costs) {
  if (!last_ || request.now < last_->plan.result.trajectory.startTime() - params_.release_delay) return false;
  const sarn::TimedTrajectory& trajectory = last_->plan.result.trajectory;
  const sarn::Pose2D expected = trajectory.sample(request.now).pose();
  const double turned = sarn::angleDifference(expected.theta, request.robot.theta);
  return (expected.position() - request.robot.position()).norm() <= params_.max_position_error &&
         std::abs(turned) <= params_.max_heading_error &&
         !sarn_navigation::firstConflict(trajectory, costs, request.now, request.now + params_.release_delay,
                                         &footprint_);
}

bool PlanContinuation::leadsToGoal(const ContinuationRequest& request, const sarn::TimedCostmapView& costs) {
  const sarn::TimedTrajectory& trajectory = last_->plan.result.trajectory;
  return last_->plan.result.status == PlanStatus::kComplete && same(last_->wanted, request.goal) &&
         !sarn_navigation::firstConflict(trajectory, costs, request.now, trajectory.endTime(), &footprint_);
}

/// As the navigator does: a robot that changes its mind at every search, between two sides to pass on, passes
/// on neither and nobody can read it.
bool PlanContinuation::keepsLast(const ContinuationRequest& request, const PlanResult& offered,
                                 const sarn::TimedCostmapView& costs) {
  if (!leadsToGoal(request, costs)) return false;
  if (offered.status != PlanStatus::kComplete) return true;
  const double release = offered.trajectory.startTime();
  if (last_->plan.result.trajectory.endTime() <= release) return false;
  const lattice_planner::PlannerParams params = planner_.params();
  const auto cost = [&](const sarn::TimedTrajectory& trajectory) {
    return lattice_planner::trajectoryCost(params, trajectory, costs, release);
  };
  return cost(offered.trajectory) > params_.keep_plan_ratio * cost(last_->plan.result.trajectory);
}

ContinuedPlan PlanContinuation::search(const sarn::TrajectoryPoint& start, const ContinuationRequest& request,
                                       const sarn::TimedCostmapView& costs) {
  const auto plan_to = [&](const sarn::Pose2D& goal) {
    ContinuedPlan plan{planner_.plan({start, goal, params_.planning_timeout, request.stop}, costs), goal};
    const PlanResult& r = plan.result;
    plan.search = SearchReport{r.search_time, r.expansions, r.bound, r.timed_out,
                               lattice_planner::isDrivable(r.status) && !r.trajectory.empty()};
    return plan;
  };
  ContinuedPlan plan = plan_to(request.goal);
  const double tolerance = std::max(request.tolerance, params_.default_tolerance);
  if (!goalIsTaken(plan.result.status) || tolerance <= 0.0) return plan;
  const auto free = nearestFree(costs, request.goal, tolerance, planner_.params().forbidden_cost);
  return free ? plan_to(*free) : plan;
}

ContinuedPlan PlanContinuation::plan(const ContinuationRequest& request,
                                     const sarn::TimedCostmapView& costs) {
  const double release = request.now + params_.release_delay;
  footprint_.reset(costs);
  if (!isDriven(request, costs)) last_.reset();
  if (last_) {
    const double to_its_end = last_->plan.result.trajectory.endTime() - request.now;
    const double arriving = std::max(params_.arrival_time, params_.release_delay);
    if (std::abs(to_its_end) < arriving && leadsToGoal(request, costs))
      return {last_->plan.result, last_->plan.goal};
  }
  sarn::TimedTrajectory committed;
  if (last_) committed = lattice_planner::commit(last_->plan.result.trajectory, request.now, release);
  const sarn::Pose2D& p = request.robot;
  const sarn::TrajectoryPoint start = committed.empty()
                                          ? sarn::TrajectoryPoint{p.x, p.y, p.theta, 0.0, 0.0, release}
                                          : committed.points.back();
  ContinuedPlan plan = search(start, request, costs);
  if (!committed.empty() && keepsLast(request, plan.result, costs)) {
    return {last_->plan.result, last_->plan.goal, plan.search};
  }
  if (!lattice_planner::isDrivable(plan.result.status) || plan.result.trajectory.empty()) return plan;
  plan.result.trajectory = lattice_planner::join(committed, plan.result.trajectory);
  last_ = Last{plan, request.goal};
  return plan;
}

std::optional<sarn::Pose2D> nearestFree(const sarn::TimedCostmapView& costs, const sarn::Pose2D& goal,
                                        double tolerance, int forbidden) {
  const sarn::GridGeometry& grid = costs.geometry;
  const sarn::CellIndex low = grid.cellAtUnbounded(goal.x - tolerance, goal.y - tolerance);
  const sarn::CellIndex high = grid.cellAtUnbounded(goal.x + tolerance, goal.y + tolerance);
  std::optional<sarn::Pose2D> nearest;
  double best = tolerance;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!grid.contains({x, y}) || costs.static_costs[grid.index({x, y})] >= forbidden) continue;
      const Eigen::Vector2d center = grid.center({x, y});
      const double distance = (center - goal.position()).norm();
      if (distance > best) continue;
      best = distance;
      nearest = sarn::Pose2D{center.x(), center.y(), goal.theta};
    }
  }
  return nearest;
}

}  // namespace sarn_move_base
