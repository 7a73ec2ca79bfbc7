// SPDX-License-Identifier: BSD-3-Clause
#include "cost_to_go.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lattice_planner {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Of what people add to the way.
constexpr float kPassingShare = 0.7F;   // timing avoids much of it
constexpr float kStayingShare = 0.85F;  // less where some of them stay

}  // namespace

CostToGo::CostToGo(const SearchTask& task)
    : task_(task), table_(task.params, task.lattice), alignment_(task.lattice), crowded_map_(task) {}

void CostToGo::reset(const EscapeZone& escape, std::function<bool()> keep_going) {
  exempt_ = nullptr;
  if (escape.active()) {
    exempt_ = [&escape](const sarn::CellIndex& cell) { return escape.exemptsStatic(cell); };
  }
  crowded_ = false;
  crowded_field_.setKeepGoing(keep_going);
  field_.setKeepGoing(std::move(keep_going));
  field_.reset(fieldTask());
}

/// Over the static layer.
DistanceFieldTask CostToGo::fieldTask() const {
  const PlanRequest& request = task_.request;
  DistanceFieldTask task;
  task.geometry = task_.costmap.geometry;
  task.costs = task_.costmap.static_costs;
  task.blocked = &task_.cell_costs.forbidden_static;
  task.rate = &task_.cell_costs.static_per_metre;
  task.start_x = request.start.x;
  task.start_y = request.start.y;
  task.goal_x = request.goal.x;
  task.goal_y = request.goal.y;
  task.goal_radius = task_.params.xy_goal_tolerance;
  if (task_.params.charge_cells) task.guess_scale = 1.0F;  // octile is longer
  task.exempt = exempt_;
  if (!table_.empty()) {
    task.floor_radius = table_.radius();
    task.floor_id = request.goal.theta;
    task.floor = [this](const sarn::CellIndex& cell) {
      const Eigen::Vector2d center = task_.costmap.geometry.center(cell);
      const Eigen::Vector2d p = task_.inGoalFrame(center.x(), center.y());
      return table_.floorAt(p.x(), p.y());
    };
  }
  return task;
}

void CostToGo::look() {
  if (task_.time.lastLayer() < 0) return;
  const PlanRequest& request = task_.request;
  SpaceTimeTask task;
  task.costmap = &task_.costmap;
  task.static_rate = &task_.cell_costs.static_rate;
  task.social_rate = &task_.cell_costs.social_rate;
  task.forbidden_static = &task_.cell_costs.forbidden_static;
  task.forbidden_social = &task_.cell_costs.forbidden_social;
  task.combine_with_max = task_.params.combine_with_max;
  task.time_weight = task_.params.time_weight;
  task.length_weight = task_.params.length_weight;
  task.max_speed = task_.lattice.maxSpeed();
  task.goal_x = request.goal.x;
  task.goal_y = request.goal.y;
  task.goal_radius = task_.params.xy_goal_tolerance;
  task.start_x = request.start.x;
  task.start_y = request.start.y;
  task.start_time = request.start.t;
  task.end_time = request.start.t + task_.time.mergeStep() * task_.params.time_step;
  crowded_ = crowded_map_.reset();
  if (crowded_) {
    DistanceFieldTask among = fieldTask();
    among.costs = crowded_map_.costs();
    among.blocked = &crowded_map_.blocked();
    among.rate = &crowded_map_.perMetre();
    crowded_field_.reset(among);
  }
  people_field_.reset(task, field_, crowded_ ? &crowded_field_ : nullptr);
}

void CostToGo::judge(SearchState& state) {
  const Eigen::Vector2d p = task_.inGoalFrame(state.x, state.y);
  const GoalTable::Value near =
      table_.at(p.x(), p.y(), state.theta - task_.request.goal.theta, state.v, state.omega);
  state.h = std::max(boundAt(state.x, state.y), near.bound);
  state.estimate = state.h;
  if (state.h == kInfinity) return;
  const SpaceTimeField::Estimate place = guessAt(state);
  state.estimate = std::max(state.h, table_.covers(p.x(), p.y()) ? std::max(place.cost, near.guess)
                                                                 : place.cost + turning(state, place));
}

/// The way on from a state's place: at first what people add to it, where the time layers end the way round
/// those who stay.
SpaceTimeField::Estimate CostToGo::guessAt(const SearchState& state) {
  const DistanceField::Guess way = field_.guess(state.x, state.y);
  SpaceTimeField::Estimate place{way.cost, way.slope_x, way.slope_y};
  if (task_.time.lastLayer() < 0) return place;
  if (crowded_ && state.step >= task_.time.mergeStep()) {
    const DistanceField::Guess late = crowded_field_.guess(state.x, state.y);
    if (late.cost == kInfinity) return place;
    return {std::max(way.cost, late.cost), late.slope_x, late.slope_y};
  }
  const auto crowded = people_field_.at(state.x, state.y, task_.timeOf(state));
  if (crowded.cost == kInfinity) return place;
  place = crowded;
  const float share = crowded_ ? kStayingShare : kPassingShare;
  place.cost = way.cost + share * std::max(0.0F, crowded.cost - way.cost);
  return place;
}

/// What it costs to get going down the slope; less where the slope is no way at all.
float CostToGo::turning(const SearchState& state, const SpaceTimeField::Estimate& place) const {
  const float slope = std::sqrt(place.slope_x * place.slope_x + place.slope_y * place.slope_y);
  const float share = std::min(1.0F, slope / static_cast<float>(task_.lattice.costPerMetre()));
  const auto direction = static_cast<double>(std::atan2(-place.slope_y, -place.slope_x));
  return share * alignment_.at(state.theta - direction, state.v, state.omega);
}

}  // namespace lattice_planner
