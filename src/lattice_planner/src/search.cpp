// SPDX-License-Identifier: BSD-3-Clause
#include "search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace lattice_planner {
namespace {

constexpr std::size_t kOverMemory = 1000;  // states: those of the last expansion, and of braking
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Search::Search(const PlannerParams& params)
    : task_(params),
      cost_to_go_(task_),
      motions_(task_),
      merge_key_(task_),
      effort_(task_.params),
      partial_plan_(task_, motions_, pool_) {}

PlanResult Search::plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  using Clock = SearchEffort::Clock;
  const Clock::time_point begin = Clock::now();
  first_plan_.reset();
  PlanResult result;
  const std::optional<PlanStatus> refused = task_.refuse(request, costmap);
  if (refused) {
    result.status = *refused;
  } else {
    const std::chrono::duration<double> limit(std::min(request.time_limit, 1e6));
    prepare(request, costmap, begin + std::chrono::duration_cast<Clock::duration>(limit));
    if (motions_.goalOccupied()) {
      result.status = PlanStatus::kGoalOccupied;
    } else {
      finish(run(), result);
    }
  }
  const auto since_begin = [begin](Clock::time_point t) {
    return std::chrono::duration<double>(t - begin).count();
  };
  if (first_plan_) result.first_plan_time = since_begin(*first_plan_);
  result.search_time = since_begin(Clock::now());
  return result;
}

void Search::prepare(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                     SearchEffort::Clock::time_point deadline) {
  effort_.begin(deadline, request.stop);
  pool_.reset(static_cast<std::size_t>(task_.params.max_states) + kOverMemory);
  open_.clear();
  columns_.clear();
  in_columns_ = false;
  partial_plan_.reset();
  best_goal_ = kNoState;
  best_cost_ = std::numeric_limits<double>::infinity();
  task_.reset(request, costmap);
  merge_key_.reset();
  motions_.reset();
  cost_to_go_.reset(motions_.escape(), [this] { return effort_.beforeDeadline(); });
}

StateId Search::addStart() {
  const sarn::TrajectoryPoint& from = task_.request.start;
  SearchState start;
  start.x = from.x;
  start.y = from.y;
  start.theta = from.theta;
  start.h = cost_to_go_.boundAt(start.x, start.y);
  start.estimate = start.h;
  start.escaping = motions_.startsInside();
  const auto nearest = [](double speed, int count, const auto& value) {
    int best = 0;
    for (int i = 1; i < count; ++i) {
      if (std::abs(value(i) - speed) < std::abs(value(best) - speed)) best = i;
    }
    return static_cast<std::uint8_t>(best);
  };
  const MotionLattice& lattice = task_.lattice;
  start.v = nearest(from.v, lattice.forwardSpeeds(), [&lattice](int i) { return lattice.v(i); });
  start.omega = nearest(from.omega, lattice.angularSpeeds(), [&lattice](int i) { return lattice.omega(i); });
  return pool_.put(merge_key_.of(start), start);
}

float Search::keyOf(const SearchState& state) const {
  const double weight = in_columns_ ? 1.0 : effort_.weight();
  return static_cast<float>(state.g + weight * static_cast<double>(state.estimate));
}

void Search::open(StateId id) {
  const SearchState& state = pool_[id];
  const OpenList::Entry entry{keyOf(state), state.h, id};
  if (in_columns_) {
    columns_.push(state.step, entry);
  } else {
    open_.push(entry);
  }
  frontier_.add(state.f());
}

bool Search::proved() {
  return best_goal_ != kNoState && best_cost_ <= task_.params.suboptimality_bound * frontier_.lowest();
}

bool Search::goodEnough() {
  if (!effort_.improvedEnough()) return false;
  if (task_.params.promising_expansions == 0) return true;
  double cheapest = best_cost_;
  const auto look = [&](const OpenList::Entry& entry) {
    const SearchState& state = pool_[entry.id];
    if (!state.done) cheapest = std::min(cheapest, state.g + static_cast<double>(state.estimate));
  };
  open_.forEach(look);
  columns_.forEach(look);
  if (!effort_.goesOn(cheapest / best_cost_)) return true;
  if (!in_columns_) sortIntoColumns();
  return false;
}

Search::Outcome Search::run() {
  const StateId start = addStart();
  if (pool_[start].h == kInfinity) return Outcome::kExhausted;
  frontier_.reset(std::max(1e-3, static_cast<double>(pool_[start].h) / 1024.0));
  const bool standing = task_.request.start.v == 0.0 && task_.request.start.omega == 0.0;
  if (standing && task_.isGoal(pool_[start])) {
    acceptGoal(start);
    return Outcome::kProved;
  }
  cost_to_go_.look();
  open(start);
  while (anyOpen()) {
    if (effort_.spent(pool_.size())) return Outcome::kOutOfTime;
    const OpenList::Entry entry = in_columns_ ? columns_.pop() : open_.pop();
    SearchState& state = pool_[entry.id];
    if (state.done) continue;
    state.done = true;
    frontier_.remove(state.f());
    if (state.f() >= best_cost_) continue;
    expand(entry.id);
    if (best_goal_ == kNoState && effort_.hurries()) reorderOpen();
    if (proved()) return Outcome::kProved;
    if (goodEnough()) return Outcome::kGoodEnough;
  }
  return best_goal_ != kNoState ? Outcome::kProved : Outcome::kExhausted;
}

void Search::expand(StateId id) {
  effort_.countExpansion();
  partial_plan_.note(id);
  const SearchState from = pool_[id];  // the pool may move while it grows
  const double c = std::cos(from.theta);
  const double s = std::sin(from.theta);
  // All successors first: what is known of their cells comes from memory while the others are made.
  successors_.clear();
  for (const MotionPrimitive& action : task_.actions(id, from)) {
    effort_.countSuccessor();
    // Octile distances may be shorter than the way.
    const double least = from.g + static_cast<double>(action.base_cost);
    if (!task_.params.charge_cells && least >= best_cost_) continue;
    Successor successor{&action, {}, 0};
    if (!motions_.advance(from, action, c, s, successor.state)) continue;
    successor.state.parent = id;
    successor.key = merge_key_.of(successor.state);
    pool_.prefetch(successor.key);
    successors_.push_back(successor);
  }
  for (const Successor& successor : successors_) tryAction(from, successor, c, s);
}

void Search::tryAction(const SearchState& from, const Successor& successor, double c, double s) {
  SearchState next = successor.state;
  if (!from.escaping) {  // cheap rejection before the costly one
    const StateId known = pool_.find(successor.key);
    if (known != kNoState && pool_[known].g <= next.g) return;
  }
  float charged = 0.0F;
  if (!motions_.traverse(from, *successor.action, c, s, charged, next.escaping)) return;
  next.g += static_cast<double>(charged);
  const std::uint64_t key = from.escaping ? merge_key_.of(next) : successor.key;
  const StateId known = pool_.find(key);
  if (known != kNoState && pool_[known].g <= next.g) return;
  cost_to_go_.judge(next);
  if (next.h == kInfinity || next.f() >= best_cost_) return;
  if (known != kNoState && !pool_[known].done) {
    pool_[known].done = true;
    frontier_.remove(pool_[known].f());
  }
  const StateId id = pool_.put(key, next);
  if (task_.isGoal(next)) {
    acceptGoal(id);
  } else {
    open(id);
  }
}

/// A plan is in hand: from here on only cheaper ones count. It is taken for the optimum only when no open
/// state has a smaller f, which is the goal test at expansion.
void Search::acceptGoal(StateId id) {
  if (best_goal_ == kNoState) first_plan_ = SearchEffort::Clock::now();
  effort_.planFound(best_goal_ == kNoState);
  best_goal_ = id;
  best_cost_ = pool_[id].g;
  pool_[id].done = true;
  if (!in_columns_) reorderOpen();
}

/// From here on the open states are taken from all time steps in turn.
void Search::sortIntoColumns() {
  in_columns_ = true;
  open_.forEach([this](const OpenList::Entry& entry) {
    const SearchState& state = pool_[entry.id];
    if (!state.done) columns_.push(state.step, {keyOf(state), state.h, entry.id});
  });
  open_.clear();
}

/// Sorts the open states by the present weight; without those that cannot lead to a cheaper plan.
void Search::reorderOpen() {
  open_.rebuild([this](OpenList::Entry& entry) {
    SearchState& state = pool_[entry.id];
    if (state.done) return false;
    if (state.f() >= best_cost_) {
      state.done = true;
      frontier_.remove(state.f());
      return false;
    }
    entry.key = keyOf(state);
    return true;
  });
}

void Search::finish(Outcome outcome, PlanResult& result) {
  result.expansions = effort_.expansions();
  result.generated = effort_.generated();
  result.timed_out = outcome == Outcome::kOutOfTime;
  if (best_goal_ == kNoState) {
    const PartialPlan::Ending ending = partial_plan_.best(result.timed_out);
    result.status = ending.status;
    result.timed_out = ending.timed_out;
    result.cost = pool_[ending.state].g;
    result.trajectory = trajectoryTo(ending.state);
    return;
  }
  result.status = PlanStatus::kComplete;
  result.cost = best_cost_;
  const double lowest = !anyOpen() ? best_cost_ : frontier_.lowest();
  result.bound = lowest > 0.0 ? std::max(1.0, best_cost_ / lowest) : 1.0;
  result.trajectory = trajectoryTo(best_goal_);
}

sarn::TimedTrajectory Search::trajectoryTo(StateId id) const {
  sarn::TimedTrajectory trajectory;
  for (StateId i = id; i != 0; i = pool_[i].parent) {
    const SearchState& state = pool_[i];
    trajectory.points.push_back({state.x, state.y, state.theta, task_.lattice.v(state.v),
                                 task_.lattice.omega(state.omega), task_.timeOf(state)});
  }
  trajectory.points.push_back(task_.request.start);
  std::reverse(trajectory.points.begin(), trajectory.points.end());
  return trajectory;
}

}  // namespace lattice_planner
