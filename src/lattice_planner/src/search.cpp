// SPDX-License-Identifier: BSD-3-Clause
#include "search.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sarn_common/angles.h"

namespace lattice_planner {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kPeopleShare = 0.7F;  // of what people add to the way: timing avoids much of it
constexpr double kHurry = 1.5;
constexpr double kHurriedWeight = 5.0;
constexpr double kFullCost = 252.0;               // the largest cost that may be entered
constexpr std::uint8_t kUnknownCountsAs = 126;    // when it may be entered
constexpr std::uint32_t kLongestTimeAxis = 2000;  // [time steps]

bool finite(const sarn::TrajectoryPoint& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.theta) && std::isfinite(p.v) &&
         std::isfinite(p.omega) && std::isfinite(p.t);
}

bool usable(const sarn::TimedCostmapView& costmap) {
  const sarn::GridGeometry& g = costmap.geometry;
  return g.width > 0 && g.height > 0 && g.resolution > 0.0 && std::isfinite(g.resolution) &&
         std::isfinite(g.origin_x) && std::isfinite(g.origin_y) && costmap.static_costs != nullptr &&
         costmap.layer_duration > 0.0 && std::isfinite(costmap.layer_duration) &&
         std::isfinite(costmap.first_layer_time) &&
         std::none_of(costmap.layers.begin(), costmap.layers.end(),
                      [](const auto* layer) { return layer == nullptr; });
}

}  // namespace

Search::Search(const PlannerParams& params)
    : params_(params), lattice_(params), table_(params, lattice_), alignment_(lattice_) {
  const double sample_time = params.time_step / lattice_.samplesPerStep();
  for (std::size_t cost = 0; cost < 256; ++cost) {
    const bool unknown = cost == sarn::kNoInformation;
    const bool too_high = !unknown && cost >= static_cast<std::size_t>(params.forbidden_cost);
    forbidden_static_[cost] = too_high || (unknown && !params.allow_unknown);
    forbidden_social_[cost] = too_high;
    const double static_part = (unknown ? kUnknownCountsAs : static_cast<double>(cost)) / kFullCost;
    const double social_part = unknown ? 0.0 : static_cast<double>(cost) / kFullCost;
    static_cost_[cost] = static_cast<float>(params.static_weight * static_part * sample_time);
    social_cost_[cost] = static_cast<float>(params.social_weight * social_part * sample_time);
    static_rate_[cost] = static_cast<float>(params.static_weight * static_part);
    social_rate_[cost] = static_cast<float>(params.social_weight * social_part);
    static_per_metre_[cost] = static_cast<float>(lattice_.costPerMetre() +
                                                 params.static_weight * static_part / lattice_.maxSpeed());
  }
}

PlanResult Search::plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  const Clock::time_point begin = Clock::now();
  PlanResult result;
  const std::optional<PlanStatus> refused = refuse(request, costmap);
  if (refused) {
    result.status = *refused;
  } else {
    const double limit = std::min(request.time_limit, 1e6);
    deadline_ = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
    prepare(request, costmap);
    finish(run(), result);
  }
  result.search_time = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

std::optional<PlanStatus> Search::refuse(const PlanRequest& request,
                                         const sarn::TimedCostmapView& costmap) const {
  const bool goal_finite =
      std::isfinite(request.goal.x) && std::isfinite(request.goal.y) && std::isfinite(request.goal.theta);
  if (!finite(request.start) || !goal_finite || !(request.time_limit > 0.0) || !usable(costmap)) {
    return PlanStatus::kInvalidRequest;
  }
  const auto start = costmap.geometry.cellAt(request.start.x, request.start.y);
  if (!start) return PlanStatus::kStartOutsideMap;
  const auto goal = costmap.geometry.cellAt(request.goal.x, request.goal.y);
  if (!goal) return PlanStatus::kGoalOutsideMap;
  if (costmap.static_costs[costmap.geometry.index(*start)] == sarn::kLethalObstacle) {
    return PlanStatus::kStartOccupied;
  }
  if (forbidden_static_[costmap.static_costs[costmap.geometry.index(*goal)]])
    return PlanStatus::kGoalOccupied;
  return std::nullopt;
}

void Search::prepare(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  request_ = request;
  request_.start.theta = sarn::wrapAngle(request.start.theta);
  request_.goal.theta = sarn::wrapAngle(request.goal.theta);
  costmap_ = costmap;
  goal_from_map_ = sarn::inverse(request_.goal);
  start_actions_ = lattice_.fromAny({request.start.v, request.start.omega});
  const double extent =
      std::max(costmap.geometry.width, costmap.geometry.height) * costmap.geometry.resolution;
  merge_size_ = std::max(params_.merge_resolution, extent / 65535.0);  // the key has 16 bits a side
  pool_.reset();
  open_.clear();
  progress_.clear();
  weight_ = params_.heuristic_weight;
  best_goal_ = best_any_pose_ = kNoState;
  best_cost_ = std::numeric_limits<double>::infinity();
  closest_ = kInfinity;
  expansions_ = generated_ = enough_expansions_ = 0;
  hurry_at_ = static_cast<std::size_t>(params_.hurry_after);
  appendLayerAfterHorizon();
  prepareTimeAxis();
  const sarn::CellIndex start = costmap_.geometry.cellAtUnbounded(request.start.x, request.start.y);
  escape_.reset(costmap_, forbidden_static_, forbidden_social_, start, request.start.t,
                params_.escape_radius);
  prepareDistanceField();
}

/// One more layer that holds after the prediction's end: what the first, the middle and the last layer agree
/// on.
void Search::appendLayerAfterHorizon() {
  const std::size_t count = costmap_.layers.size();
  if (!params_.forget_moving_people || count < 2) return;
  const std::size_t size = costmap_.geometry.size();
  const std::uint8_t* const first = costmap_.layers.front();
  const std::uint8_t* const middle = costmap_.layers[count / 2];
  const std::uint8_t* const last = costmap_.layers.back();
  after_horizon_.resize(size);
  for (std::size_t i = 0; i < size; ++i) after_horizon_[i] = std::min(std::min(first[i], middle[i]), last[i]);
  costmap_.layers.push_back(after_horizon_.data());
}

/// Layers of the samples of each time step, up to the step from which on the last layer holds. Equal layers
/// at the end count as one: standing people do not keep states apart by time.
void Search::prepareTimeAxis() {
  last_layer_ = static_cast<int>(costmap_.layers.size()) - 1;
  int first_of_last = last_layer_;
  const std::size_t size = costmap_.geometry.size();
  while (first_of_last > 0) {
    const std::uint8_t* a = costmap_.layers[static_cast<std::size_t>(first_of_last - 1)];
    const std::uint8_t* b = costmap_.layers[static_cast<std::size_t>(last_layer_)];
    if (a != b && std::memcmp(a, b, size) != 0) break;
    --first_of_last;
  }
  layer_of_sample_.clear();
  merge_step_ = 0;
  if (first_of_last <= 0) return;
  const double changes_until = costmap_.first_layer_time + first_of_last * costmap_.layer_duration;
  const int samples = lattice_.samplesPerStep();
  const auto time = [&](std::uint32_t step, int sample) {
    return request_.start.t + (step + static_cast<double>(sample + 1) / samples) * params_.time_step;
  };
  while (merge_step_ < kLongestTimeAxis && time(merge_step_, -1) < changes_until) {
    for (int k = -1; k < samples; ++k) layer_of_sample_.push_back(costmap_.layerAt(time(merge_step_, k)));
    ++merge_step_;
  }
}

/// Time layer of a sample of an action; -1: of the action's start.
int Search::layerOf(std::uint32_t step, int sample) const {
  if (step >= merge_step_) return last_layer_;
  const auto samples = static_cast<std::size_t>(lattice_.samplesPerStep()) + 1;
  return layer_of_sample_[step * samples + static_cast<std::size_t>(sample + 1)];
}

/// Cost of one sample's time in a cell.
float Search::exposure(std::size_t index, int layer) const {
  const float static_part = static_cost_[costmap_.static_costs[index]];
  if (layer < 0) return static_part;
  const float social_part = social_cost_[costmap_.layers[static_cast<std::size_t>(layer)][index]];
  return params_.combine_with_max ? std::max(static_part, social_part) : static_part + social_part;
}

void Search::prepareDistanceField() {
  DistanceFieldTask task;
  task.geometry = costmap_.geometry;
  task.costs = costmap_.static_costs;
  task.blocked = &forbidden_static_;
  task.rate = &static_per_metre_;
  task.start_x = request_.start.x;
  task.start_y = request_.start.y;
  task.goal_x = request_.goal.x;
  task.goal_y = request_.goal.y;
  task.goal_radius = params_.xy_goal_tolerance;
  if (params_.charge_cells) task.guess_scale = 1.0F;  // octile is longer
  if (escape_.active()) {
    task.exempt = [this](const sarn::CellIndex& cell) { return escape_.exemptsStatic(cell); };
  }
  if (!table_.empty()) {
    task.floor_radius = table_.radius();
    task.floor_id = request_.goal.theta;
    task.floor = [this](const sarn::CellIndex& cell) {
      const Eigen::Vector2d p = goal_from_map_ * costmap_.geometry.center(cell);
      return table_.floorAt(p.x(), p.y());
    };
  }
  field_.setKeepGoing([this] { return Clock::now() < deadline_; });
  field_.reset(task);
}

void Search::preparePeopleField() {
  SpaceTimeTask task;
  task.costmap = &costmap_;
  task.static_rate = &static_rate_;
  task.social_rate = &social_rate_;
  task.forbidden_static = &forbidden_static_;
  task.forbidden_social = &forbidden_social_;
  task.combine_with_max = params_.combine_with_max;
  task.time_weight = params_.time_weight;
  task.length_weight = params_.length_weight;
  task.max_speed = lattice_.maxSpeed();
  task.goal_x = request_.goal.x;
  task.goal_y = request_.goal.y;
  task.goal_radius = params_.xy_goal_tolerance;
  task.start_x = request_.start.x;
  task.start_y = request_.start.y;
  task.start_time = request_.start.t;
  task.end_time = request_.start.t + merge_step_ * params_.time_step;
  people_field_.reset(task, field_);
}

/// The admissible bound and the guess. The guess: the way at its likely cost, what people add to it, and
/// turning into its direction; near the goal the table knows better.
void Search::judge(SearchState& state) {
  const Eigen::Vector2d p = goal_from_map_ * Eigen::Vector2d(state.x, state.y);
  const GoalTable::Value near =
      table_.at(p.x(), p.y(), state.theta - request_.goal.theta, state.v, state.omega);
  const DistanceField::Guess way = field_.guess(state.x, state.y);
  state.h = std::max(field_.at(costmap_.geometry.cellAtUnbounded(state.x, state.y)), near.bound);
  state.estimate = state.h;
  if (state.h == kInfinity) return;
  SpaceTimeField::Estimate place{way.cost, way.slope_x, way.slope_y};
  if (last_layer_ >= 0) {
    const auto crowded =
        people_field_.at(state.x, state.y, request_.start.t + state.step * params_.time_step);
    if (crowded.cost != kInfinity) {
      place = crowded;
      place.cost = way.cost + kPeopleShare * std::max(0.0F, crowded.cost - way.cost);
    }
  }
  if (table_.covers(p.x(), p.y())) {
    state.estimate = std::max({state.h, place.cost, near.guess});
    return;
  }
  const float slope = std::sqrt(place.slope_x * place.slope_x + place.slope_y * place.slope_y);
  const float share = std::min(1.0F, slope / static_cast<float>(lattice_.costPerMetre()));
  const auto direction = static_cast<double>(std::atan2(-place.slope_y, -place.slope_x));
  const float turning = alignment_.at(state.theta - direction, state.v, state.omega);
  state.estimate = std::max(state.h, place.cost + share * turning);
}

StateId Search::addStart() {
  SearchState start;
  start.x = request_.start.x;
  start.y = request_.start.y;
  start.theta = request_.start.theta;
  start.h = field_.at(costmap_.geometry.cellAtUnbounded(start.x, start.y));
  start.estimate = start.h;
  start.escaping = escape_.active();
  const auto nearest = [](double speed, int count, const auto& value) {
    int best = 0;
    for (int i = 1; i < count; ++i) {
      if (std::abs(value(i) - speed) < std::abs(value(best) - speed)) best = i;
    }
    return static_cast<std::uint8_t>(best);
  };
  start.v = nearest(request_.start.v, lattice_.forwardSpeeds(), [this](int i) { return lattice_.v(i); });
  start.omega =
      nearest(request_.start.omega, lattice_.angularSpeeds(), [this](int i) { return lattice_.omega(i); });
  return pool_.put(mergeKey(start), start);
}

/// Cell, heading, speeds, time and whether it still escapes, in one word.
std::uint64_t Search::mergeKey(const SearchState& state) const {
  const sarn::GridGeometry& g = costmap_.geometry;
  const auto x = static_cast<std::uint64_t>((state.x - g.origin_x) / merge_size_) & 0xFFFFU;
  const auto y = static_cast<std::uint64_t>((state.y - g.origin_y) / merge_size_) & 0xFFFFU;
  // Bins are centred on the start's heading, which the lattice's headings are offset by.
  const double turns = (state.theta - request_.start.theta) / (2.0 * sarn::kPi);
  const long bin = std::lround((turns - std::floor(turns)) * params_.heading_bins) % params_.heading_bins;
  const auto merge = static_cast<std::uint32_t>(params_.time_merge_steps);
  const std::uint32_t time = (std::min(state.step, merge_step_) + merge - 1) / merge;
  return x | y << 16U | static_cast<std::uint64_t>(bin) << 32U | static_cast<std::uint64_t>(state.v) << 42U |
         static_cast<std::uint64_t>(state.omega) << 47U | static_cast<std::uint64_t>(time) << 52U |
         static_cast<std::uint64_t>(state.escaping) << 63U;
}

bool Search::atGoalPosition(const SearchState& state) const {
  return std::hypot(state.x - request_.goal.x, state.y - request_.goal.y) < params_.xy_goal_tolerance;
}

bool Search::isGoal(const SearchState& state) const {
  return state.v == lattice_.standingV() && state.omega == lattice_.standingOmega() &&
         atGoalPosition(state) &&
         std::abs(sarn::angleDifference(state.theta, request_.goal.theta)) < params_.yaw_goal_tolerance;
}

const std::vector<MotionPrimitive>& Search::actions(StateId id) const {
  if (id == 0) return start_actions_;
  return lattice_.from(pool_[id].v, pool_[id].omega);
}

void Search::open(StateId id) {
  const SearchState& state = pool_[id];
  open_.push({static_cast<float>(state.g + weight_ * static_cast<double>(state.estimate)), state.h, id});
  frontier_.add(state.f());
}

bool Search::outOfTime() {
  if (params_.max_expansions > 0 && expansions_ >= static_cast<std::size_t>(params_.max_expansions))
    return true;
  if (pool_.size() >= static_cast<std::size_t>(params_.max_states)) return true;
  return (expansions_ & 15U) == 0 && Clock::now() >= deadline_;
}

bool Search::proved() {
  return best_goal_ != kNoState && best_cost_ <= params_.suboptimality_bound * frontier_.lowest();
}

Search::Outcome Search::run() {
  const StateId start = addStart();
  if (pool_[start].h == kInfinity) return Outcome::kExhausted;
  frontier_.reset(std::max(1e-3, static_cast<double>(pool_[start].h) / 1024.0));
  const bool standing = request_.start.v == 0.0 && request_.start.omega == 0.0;
  if (standing && isGoal(pool_[start])) {
    acceptGoal(start);
    return Outcome::kProved;
  }
  if (last_layer_ >= 0) preparePeopleField();
  open(start);
  while (!open_.empty()) {
    if (outOfTime()) return Outcome::kOutOfTime;
    const OpenList::Entry entry = open_.pop();
    SearchState& state = pool_[entry.id];
    if (state.done) continue;
    state.done = true;
    frontier_.remove(state.f());
    if (state.f() >= best_cost_) continue;
    expand(entry.id);
    if (hurry_at_ > 0 && best_goal_ == kNoState && expansions_ >= hurry_at_) hurry();
    if (proved()) return Outcome::kProved;
    if (enough_expansions_ > 0 && expansions_ >= enough_expansions_) return Outcome::kGoodEnough;
  }
  return best_goal_ != kNoState ? Outcome::kProved : Outcome::kExhausted;
}

void Search::expand(StateId id) {
  ++expansions_;
  noteProgress(id);
  const SearchState from = pool_[id];  // the pool may move while it grows
  const double c = std::cos(from.theta);
  const double s = std::sin(from.theta);
  for (const MotionPrimitive& action : actions(id)) tryAction(from, id, action, c, s);
}

void Search::noteProgress(StateId id) {
  const SearchState& state = pool_[id];
  if (state.h < closest_) {
    closest_ = state.h;
    progress_.push_back(id);
  }
  if (atGoalPosition(state) && (best_any_pose_ == kNoState || state.f() < pool_[best_any_pose_].f())) {
    best_any_pose_ = id;
  }
}

void Search::tryAction(const SearchState& from, StateId from_id, const MotionPrimitive& action, double c,
                       double s) {
  ++generated_;
  SearchState next;
  next.g = from.g + static_cast<double>(action.base_cost);
  if (!params_.charge_cells && next.g >= best_cost_) return;
  const sarn::Pose2D& end = action.samples.back();
  next.x = from.x + c * end.x - s * end.y;
  next.y = from.y + s * end.x + c * end.y;
  const auto cell = costmap_.geometry.cellAt(next.x, next.y);
  if (!cell) return;
  if (params_.charge_cells) {
    next.g += cellsInsteadOfLength(costmap_.geometry.cellAtUnbounded(from.x, from.y), *cell, action);
  }
  next.theta = sarn::wrapAngle(from.theta + action.dtheta);
  next.v = action.v;
  next.omega = action.omega;
  next.step = from.step + 1;
  next.parent = from_id;
  if (!from.escaping) {  // cheap rejection before the costly one
    const StateId known = pool_.find(mergeKey(next));
    if (known != kNoState && pool_[known].g <= next.g) return;
  }
  float charged = 0.0F;
  next.escaping = from.escaping;
  if (!traverse(from, action, c, s, charged, next.escaping)) return;
  next.g += static_cast<double>(charged);
  const std::uint64_t key = mergeKey(next);
  const StateId known = pool_.find(key);
  if (known != kNoState && pool_[known].g <= next.g) return;
  judge(next);
  if (next.h == kInfinity || next.f() >= best_cost_) return;
  if (known != kNoState && !pool_[known].done) {
    pool_[known].done = true;
    frontier_.remove(pool_[known].f());
  }
  const StateId id = pool_.put(key, next);
  if (isGoal(next)) {
    acceptGoal(id);
  } else {
    open(id);
  }
}

/// What the octile distance between two cells costs more than the action's length.
double Search::cellsInsteadOfLength(const sarn::CellIndex& from, const sarn::CellIndex& to,
                                    const MotionPrimitive& action) const {
  const int dx = std::abs(to.x - from.x);
  const int dy = std::abs(to.y - from.y);
  const double cells = std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
  return params_.length_weight * (cells * costmap_.geometry.resolution - static_cast<double>(action.length));
}

/// Collision and exposure along one action: each sample stands for its share of the time step. False: not
/// allowed.
bool Search::traverse(const SearchState& from, const MotionPrimitive& action, double c, double s, float& cost,
                      bool& escaping) {
  const sarn::GridGeometry& g = costmap_.geometry;
  sarn::CellIndex last = g.cellAtUnbounded(from.x, from.y);
  const int layer_at_start = params_.charge_cells ? layerOf(from.step, -1) : -1;
  if (params_.charge_cells) cost += exposure(g.index(last), layer_at_start);
  for (int k = 0; k < lattice_.samplesPerStep(); ++k) {
    const sarn::Pose2D& sample = action.samples[static_cast<std::size_t>(k)];
    const auto cell = g.cellAt(from.x + c * sample.x - s * sample.y, from.y + s * sample.x + c * sample.y);
    if (!cell) return false;
    const int layer = params_.charge_cells ? layer_at_start : layerOf(from.step, k);
    const std::size_t index = g.index(*cell);
    const std::uint8_t static_cost = costmap_.static_costs[index];
    const std::uint8_t social_cost =
        layer < 0 ? sarn::kFreeSpace : costmap_.layers[static_cast<std::size_t>(layer)][index];
    if (forbidden_static_[static_cost] || forbidden_social_[social_cost]) {
      if (!escaping || !escape_.allows(last, *cell, layer)) return false;
    } else {
      escaping = false;
    }
    cost += exposure(index, layer);
    last = *cell;
  }
  return true;
}

/// A plan is in hand: from here on only cheaper ones count, and the weight falls so that the bound can be
/// proved. It is taken for the optimum only when no open state has a smaller f, which is the goal test at
/// expansion.
void Search::acceptGoal(StateId id) {
  if (best_goal_ == kNoState && params_.improvement_effort > 0.0) {
    const double more =
        params_.improvement_effort * static_cast<double>(expansions_) + params_.least_improvement;
    enough_expansions_ = expansions_ + static_cast<std::size_t>(more);
  }
  best_goal_ = id;
  best_cost_ = pool_[id].g;
  pool_[id].done = true;
  weight_ = weight_ > 1.1 ? 1.0 + 0.5 * (weight_ - 1.0) : 1.0;
  reorderOpen();
}

/// No plan after much work: the guess errs here. Better a dearer plan soon than none; its bound tells.
void Search::hurry() {
  hurry_at_ *= 2;
  weight_ = std::min(kHurriedWeight, weight_ * kHurry);
  reorderOpen();
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
    entry.key = static_cast<float>(state.g + weight_ * static_cast<double>(state.estimate));
    return true;
  });
}

void Search::finish(Outcome outcome, PlanResult& result) {
  result.expansions = expansions_;
  result.generated = generated_;
  result.timed_out = outcome == Outcome::kOutOfTime;
  if (best_goal_ == kNoState) {
    finishPartial(outcome, result);
    return;
  }
  result.status = PlanStatus::kComplete;
  result.cost = best_cost_;
  const double lowest = open_.empty() ? best_cost_ : frontier_.lowest();
  result.bound = lowest > 0.0 ? std::max(1.0, best_cost_ / lowest) : 1.0;
  result.trajectory = trajectoryTo(best_goal_);
}

/// The paper's fallback: the goal at any heading and speed, else the best expanded state; each brought to a
/// safe stop.
void Search::finishPartial(Outcome outcome, PlanResult& result) {
  if (!staticallyConnected()) {  // coming closer as the crow flies would be of no use
    progress_.clear();
    best_any_pose_ = kNoState;
    outcome = Outcome::kExhausted;
    result.timed_out = false;
  }
  std::vector<StateId> candidates;
  if (best_any_pose_ != kNoState) candidates.push_back(best_any_pose_);
  candidates.insert(candidates.end(), progress_.rbegin(), progress_.rend());
  if (candidates.empty() || candidates.back() != 0) candidates.push_back(0);
  std::optional<StateId> end;
  StateId from = 0;
  for (const bool free_of_people : {true, false}) {
    for (const StateId candidate : candidates) {
      const std::optional<StateId> stop = safeStop(candidate, true);
      if (!stop || (free_of_people && !standsFreeOfPeople(*stop))) continue;
      end = stop;
      from = candidate;
      break;
    }
    if (end) break;
  }
  if (!end) end = safeStop(0, false);  // braking at once is the least harm
  const bool closer = from != 0 && pool_[from].h < pool_[0].h;
  if (closer && from == best_any_pose_) {
    result.status = PlanStatus::kGoalAnyPose;
  } else if (closer || outcome == Outcome::kOutOfTime) {
    result.status = PlanStatus::kPartial;
  } else {
    result.status = PlanStatus::kNoPath;
  }
  result.cost = pool_[*end].g;
  result.trajectory = trajectoryTo(*end);
}

/// Is there any way from start to goal in the static layer, for a robot that moves from cell to cell?
bool Search::staticallyConnected() const {
  const sarn::GridGeometry& g = costmap_.geometry;
  std::vector<bool> seen(g.size(), false);
  std::vector<sarn::CellIndex> reached;
  const auto visit = [&](const sarn::CellIndex& cell) {
    if (!g.contains(cell) || seen[g.index(cell)]) return;
    if (forbidden_static_[costmap_.static_costs[g.index(cell)]] && !escape_.exemptsStatic(cell)) return;
    seen[g.index(cell)] = true;
    reached.push_back(cell);
  };
  visit(g.cellAtUnbounded(request_.start.x, request_.start.y));
  const double half = 0.5 * g.resolution;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const sarn::CellIndex cell = reached[i];
    const Eigen::Vector2d p = g.center(cell);
    const double dx = std::max(0.0, std::abs(p.x() - request_.goal.x) - half);
    const double dy = std::max(0.0, std::abs(p.y() - request_.goal.y) - half);
    if (std::hypot(dx, dy) < params_.xy_goal_tolerance - 1e-9) return true;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) visit({cell.x + x, cell.y + y});
    }
  }
  return false;
}

/// Brakes from a state as hard as the lattice can, on the first arc that is free at the time; the standing
/// state.
std::optional<StateId> Search::safeStop(StateId from_id, bool check_collisions) {
  const SearchState from = pool_[from_id];
  const auto slower = [](int next, int now, int standing) {
    return std::abs(next - standing) < std::abs(now - standing);
  };
  const bool off_lattice = from_id == 0;
  const bool v_stands = from.v == lattice_.standingV() && (!off_lattice || request_.start.v == 0.0);
  const bool omega_stands =
      from.omega == lattice_.standingOmega() && (!off_lattice || request_.start.omega == 0.0);
  if (v_stands && omega_stands) return from_id;
  std::vector<MotionPrimitive> options = actions(from_id);
  std::stable_sort(
      options.begin(), options.end(), [this](const MotionPrimitive& a, const MotionPrimitive& b) {
        const auto speed = [](int i, int standing) { return std::abs(i - standing); };
        const int va = speed(a.v, lattice_.standingV());
        const int vb = speed(b.v, lattice_.standingV());
        if (va != vb) return va < vb;
        return speed(a.omega, lattice_.standingOmega()) < speed(b.omega, lattice_.standingOmega());
      });
  for (const MotionPrimitive& action : options) {
    if (!off_lattice) {
      const bool brakes =
          v_stands ? action.v == from.v && slower(action.omega, from.omega, lattice_.standingOmega())
                   : slower(action.v, from.v, lattice_.standingV());
      if (!brakes) continue;
    } else if (std::abs(lattice_.v(action.v)) > std::abs(request_.start.v) + 1e-9 ||
               std::abs(lattice_.omega(action.omega)) > std::abs(request_.start.omega) + 1e-9) {
      continue;
    }
    SearchState next;
    const double c = std::cos(from.theta);
    const double s = std::sin(from.theta);
    float charged = 0.0F;
    next.escaping = from.escaping;
    if (check_collisions && !traverse(from, action, c, s, charged, next.escaping)) continue;
    const sarn::Pose2D& end = action.samples.back();
    next.x = from.x + c * end.x - s * end.y;
    next.y = from.y + s * end.x + c * end.y;
    next.theta = sarn::wrapAngle(from.theta + action.dtheta);
    next.g = from.g + static_cast<double>(action.base_cost) + static_cast<double>(charged);
    if (params_.charge_cells) {
      const sarn::GridGeometry& g = costmap_.geometry;
      next.g +=
          cellsInsteadOfLength(g.cellAtUnbounded(from.x, from.y), g.cellAtUnbounded(next.x, next.y), action);
    }
    next.v = action.v;
    next.omega = action.omega;
    next.step = from.step + 1;
    next.parent = from_id;
    next.done = true;
    const auto stop = safeStop(pool_.add(next), check_collisions);
    if (stop) return stop;
  }
  return std::nullopt;
}

/// True when no person comes to where the robot stands, from then to the end of the horizon.
bool Search::standsFreeOfPeople(StateId id) const {
  const SearchState& state = pool_[id];
  const auto cell = costmap_.geometry.cellAt(state.x, state.y);
  if (!cell || last_layer_ < 0) return cell.has_value();
  const std::size_t index = costmap_.geometry.index(*cell);
  const int first = costmap_.layerAt(request_.start.t + state.step * params_.time_step);
  for (int layer = first; layer <= last_layer_; ++layer) {
    if (forbidden_social_[costmap_.layers[static_cast<std::size_t>(layer)][index]]) return false;
  }
  return true;
}

sarn::TimedTrajectory Search::trajectoryTo(StateId id) const {
  sarn::TimedTrajectory trajectory;
  for (StateId i = id; i != 0; i = pool_[i].parent) {
    const SearchState& state = pool_[i];
    trajectory.points.push_back({state.x, state.y, state.theta, lattice_.v(state.v),
                                 lattice_.omega(state.omega),
                                 request_.start.t + state.step * params_.time_step});
  }
  trajectory.points.push_back(request_.start);
  std::reverse(trajectory.points.begin(), trajectory.points.end());
  return trajectory;
}

}  // namespace lattice_planner
