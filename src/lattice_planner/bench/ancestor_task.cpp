// SPDX-License-Identifier: BSD-3-Clause
#include "ancestor_task.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "sarn_common/angles.h"

namespace lattice_planner::bench {
namespace {

constexpr double kTimeCost = 200.0;  // an action
constexpr double kCellCost = 80.0;   // a cell's width
constexpr double kDiagonal = 1.414;  // of the wavefront's steps
constexpr int kForbidden = 253;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double octile(const sarn::CellIndex& a, const sarn::CellIndex& b) {
  const int dx = std::abs(a.x - b.x);
  const int dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
}

}  // namespace

void AncestorTask::reset(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  request_ = request;
  costmap_ = costmap;
  computeWavefront();
}

AncestorTask::State AncestorTask::start() const {
  return {request_.start.pose(), lattice_.standingV(), lattice_.standingOmega(), 0};
}

/// 8-connected Dijkstra over the static layer: the cell's cost and what a cell costs at full speed.
void AncestorTask::computeWavefront() {
  const sarn::GridGeometry& g = costmap_.geometry;
  const double neutral = kCellCost + kTimeCost * g.resolution / (params_.max_vel_x * params_.time_step);
  wavefront_.assign(g.size(), kInfinity);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::size_t goal = g.index(g.cellAtUnbounded(request_.goal.x, request_.goal.y));
  wavefront_[goal] = 0.0;
  open.push({0.0, goal});
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > wavefront_[index]) continue;
    const auto width = static_cast<std::size_t>(g.width);
    const sarn::CellIndex cell{static_cast<int>(index % width), static_cast<int>(index / width)};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const sarn::CellIndex to{cell.x + dx, cell.y + dy};
        if (!g.contains(to) || costmap_.static_costs[g.index(to)] >= kForbidden) continue;
        const double next =
            cost + (neutral + costmap_.static_costs[g.index(to)]) * (dx != 0 && dy != 0 ? kDiagonal : 1.0);
        if (next >= wavefront_[g.index(to)]) continue;
        wavefront_[g.index(to)] = next;
        open.push({next, g.index(to)});
      }
    }
  }
}

int AncestorTask::costAt(std::size_t cell, int layer) const {
  const int social = layer < 0 ? 0 : costmap_.layers[static_cast<std::size_t>(layer)][cell];
  return std::max<int>(costmap_.static_costs[cell], social);
}

std::optional<double> AncestorTask::costOf(const State& from, const MotionPrimitive& action,
                                           const sarn::Pose2D& end) const {
  const sarn::GridGeometry& g = costmap_.geometry;
  const auto last = g.cellAt(end.x, end.y);
  if (!last) return std::nullopt;
  const sarn::CellIndex first = g.cellAtUnbounded(from.pose.x, from.pose.y);
  const int layer = costmap_.layerAt(request_.start.t + from.step * params_.time_step);
  double cost = kTimeCost + kCellCost * octile(first, *last) + costAt(g.index(first), layer);
  for (const sarn::Pose2D& sample : action.samples) {
    const sarn::Pose2D p = from.pose * sample;
    const auto cell = g.cellAt(p.x, p.y);
    if (!cell) return std::nullopt;
    const int charged = costAt(g.index(*cell), layer);
    if (charged >= kForbidden) return std::nullopt;
    cost += charged;
  }
  return cost;
}

std::optional<double> AncestorTask::costOf(const sarn::TimedTrajectory& plan) const {
  constexpr double kSame = 1e-6;  // [m/s], [rad/s]
  State state = start();
  double cost = 0.0;
  for (std::size_t i = 1; i < plan.points.size(); ++i) {
    const sarn::TrajectoryPoint& to = plan.points[i];
    const std::vector<MotionPrimitive>& all = actions(state);
    const auto action = std::find_if(all.begin(), all.end(), [&](const MotionPrimitive& a) {
      return std::abs(lattice_.v(a.v) - to.v) < kSame && std::abs(lattice_.omega(a.omega) - to.omega) < kSame;
    });
    if (action == all.end()) return std::nullopt;
    const std::optional<double> one = costOf(state, *action, to.pose());
    if (!one) return std::nullopt;
    cost += *one;
    state = {to.pose(), action->v, action->omega, state.step + 1};
  }
  return cost;
}

sarn::TrajectoryPoint AncestorTask::pointOf(const State& state) const {
  return {state.pose.x,
          state.pose.y,
          state.pose.theta,
          lattice_.v(state.v),
          lattice_.omega(state.omega),
          request_.start.t + state.step * params_.time_step};
}

bool AncestorTask::isGoal(const State& state) const {
  const sarn::Pose2D& goal = request_.goal;
  return lattice_.v(state.v) == 0.0 && lattice_.omega(state.omega) == 0.0 &&
         std::hypot(state.pose.x - goal.x, state.pose.y - goal.y) < params_.xy_goal_tolerance &&
         std::abs(sarn::angleDifference(state.pose.theta, goal.theta)) < params_.yaw_goal_tolerance;
}

}  // namespace lattice_planner::bench
