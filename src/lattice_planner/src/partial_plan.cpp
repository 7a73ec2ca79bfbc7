// SPDX-License-Identifier: BSD-3-Clause
#include "partial_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace lattice_planner {

void PartialPlan::reset() {
  standing_ = kNoState;
  forgetProgress();
}

void PartialPlan::forgetProgress() {
  progress_.clear();
  any_pose_ = kNoState;
  closest_ = std::numeric_limits<float>::infinity();
}

void PartialPlan::note(StateId id) {
  const SearchState& state = pool_[id];
  if (state.h < closest_) {
    closest_ = state.h;
    progress_.push_back(id);
  }
  if (task_.atGoalPosition(state) && (any_pose_ == kNoState || state.f() < pool_[any_pose_].f())) {
    any_pose_ = id;
  }
  if (stands(id) && (standing_ == kNoState || state.h < pool_[standing_].h)) standing_ = id;
}

std::vector<StateId> PartialPlan::candidates() const {
  std::vector<StateId> all;
  if (any_pose_ != kNoState) all.push_back(any_pose_);
  all.insert(all.end(), progress_.rbegin(), progress_.rend());
  if (all.empty() || all.back() != 0) all.push_back(0);
  return all;
}

PartialPlan::Ending PartialPlan::best(bool timed_out) {
  if (!staticallyConnected()) {  // coming closer as the crow flies would be of no use
    forgetProgress();
    timed_out = false;
  }
  const std::vector<StateId> from_these = candidates();
  std::optional<StateId> end;
  StateId from = 0;
  for (const bool free_of_people : {true, false}) {
    for (const StateId candidate : from_these) {
      const std::optional<StateId> stop = safeStop(candidate, true);
      if (!stop || (free_of_people && !motions_.standsFreeOfPeople(pool_[*stop]))) continue;
      end = stop;
      from = candidate;
      break;
    }
    if (end) break;
  }
  // Where braking is not enough, by steering as well.
  if (!end && standing_ != kNoState) end = standing_;
  if (!end) return {*safeStop(0, false), PlanStatus::kNoPath, timed_out};  // braking is the least harm
  const bool closer = from != 0 && pool_[from].h < pool_[0].h;
  if (closer && from == any_pose_) return {*end, PlanStatus::kGoalAnyPose, timed_out};
  return {*end, closer || timed_out ? PlanStatus::kPartial : PlanStatus::kNoPath, timed_out};
}

/// Is there any way from start to goal in the static layer, for a robot that moves from cell to cell?
bool PartialPlan::staticallyConnected() const {
  const sarn::GridGeometry& g = task_.costmap.geometry;
  const PlanRequest& request = task_.request;
  std::vector<bool> seen(g.size(), false);
  std::vector<sarn::CellIndex> reached;
  const auto visit = [&](const sarn::CellIndex& cell) {
    if (!g.contains(cell) || seen[g.index(cell)]) return;
    if (task_.cell_costs.forbidden_static[task_.costmap.static_costs[g.index(cell)]] &&
        !motions_.escape().exemptsStatic(cell)) {
      return;
    }
    seen[g.index(cell)] = true;
    reached.push_back(cell);
  };
  visit(g.cellAtUnbounded(request.start.x, request.start.y));
  const double half = 0.5 * g.resolution;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const sarn::CellIndex cell = reached[i];
    const Eigen::Vector2d p = g.center(cell);
    const double dx = std::max(0.0, std::abs(p.x() - request.goal.x) - half);
    const double dy = std::max(0.0, std::abs(p.y() - request.goal.y) - half);
    if (std::hypot(dx, dy) < task_.params.xy_goal_tolerance - 1e-9) return true;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) visit({cell.x + x, cell.y + y});
    }
  }
  return false;
}

/// The start's state holds the lattice's nearest speeds; its own may differ.
bool PartialPlan::stands(StateId id) const {
  const SearchState& state = pool_[id];
  const bool standing = state.v == task_.lattice.standingV() && state.omega == task_.lattice.standingOmega();
  return standing && (id != 0 || (task_.request.start.v == 0.0 && task_.request.start.omega == 0.0));
}

bool PartialPlan::brakes(StateId from_id, const MotionPrimitive& action) const {
  const MotionLattice& lattice = task_.lattice;
  if (from_id == 0) {
    return std::abs(lattice.v(action.v)) <= std::abs(task_.request.start.v) + 1e-9 &&
           std::abs(lattice.omega(action.omega)) <= std::abs(task_.request.start.omega) + 1e-9;
  }
  const auto slower = [](int next, int now, int standing) {
    return std::abs(next - standing) < std::abs(now - standing);
  };
  const SearchState& from = pool_[from_id];
  if (from.v != lattice.standingV()) return slower(action.v, from.v, lattice.standingV());
  return action.v == from.v && slower(action.omega, from.omega, lattice.standingOmega());
}

/// The hardest braking first.
std::vector<MotionPrimitive> PartialPlan::brakingActions(StateId from) const {
  std::vector<MotionPrimitive> all;
  for (const MotionPrimitive& action : task_.actions(from, pool_[from])) {
    if (brakes(from, action)) all.push_back(action);
  }
  const MotionLattice& lattice = task_.lattice;
  std::stable_sort(all.begin(), all.end(), [&lattice](const MotionPrimitive& a, const MotionPrimitive& b) {
    const auto speed = [](int i, int standing) { return std::abs(i - standing); };
    const int va = speed(a.v, lattice.standingV());
    const int vb = speed(b.v, lattice.standingV());
    if (va != vb) return va < vb;
    return speed(a.omega, lattice.standingOmega()) < speed(b.omega, lattice.standingOmega());
  });
  return all;
}

/// Brakes from a state on the first arc that is free at the time; the standing state.
std::optional<StateId> PartialPlan::safeStop(StateId from_id, bool check_collisions) {
  if (stands(from_id)) return from_id;
  const SearchState from = pool_[from_id];  // the pool may move while it grows
  const double c = std::cos(from.theta);
  const double s = std::sin(from.theta);
  for (const MotionPrimitive& action : brakingActions(from_id)) {
    SearchState next;
    const bool on_map = motions_.advance(from, action, c, s, next);
    if (check_collisions) {
      float charged = 0.0F;
      if (!on_map || !motions_.traverse(from, action, c, s, charged, next.escaping)) continue;
      next.g += static_cast<double>(charged);
    }
    next.parent = from_id;
    next.done = true;
    const auto stop = safeStop(pool_.add(next), check_collisions);
    if (stop) return stop;
  }
  return std::nullopt;
}

}  // namespace lattice_planner
