// SPDX-License-Identifier: BSD-3-Clause
#include "search_task.h"

#include <algorithm>

namespace lattice_planner {
namespace {

constexpr double kLargestCell = 0.1;  // [m] that guides the search well

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

std::optional<PlanStatus> SearchTask::refuse(const PlanRequest& wanted,
                                             const sarn::TimedCostmapView& costs) const {
  const bool goal_finite =
      std::isfinite(wanted.goal.x) && std::isfinite(wanted.goal.y) && std::isfinite(wanted.goal.theta);
  if (!finite(wanted.start) || !goal_finite || !(wanted.time_limit > 0.0) || !usable(costs)) {
    return PlanStatus::kInvalidRequest;
  }
  const auto start = costs.geometry.cellAt(wanted.start.x, wanted.start.y);
  if (!start) return PlanStatus::kStartOutsideMap;
  const auto goal = costs.geometry.cellAt(wanted.goal.x, wanted.goal.y);
  if (!goal) return PlanStatus::kGoalOutsideMap;
  if (costs.static_costs[costs.geometry.index(*start)] == sarn::kLethalObstacle) {
    return PlanStatus::kStartOccupied;
  }
  const std::uint8_t at_goal = costs.static_costs[costs.geometry.index(*goal)];
  if (!cell_costs.forbidden_static[at_goal]) return std::nullopt;
  return at_goal == sarn::kNoInformation ? PlanStatus::kGoalUnknown : PlanStatus::kGoalOccupied;
}

void SearchTask::reset(const PlanRequest& wanted, const sarn::TimedCostmapView& costs) {
  request = wanted;
  request.start.theta = sarn::wrapAngle(wanted.start.theta);
  request.goal.theta = sarn::wrapAngle(wanted.goal.theta);
  // The ancestor charges cells: there, finer ones would be another cost.
  costmap = params.charge_cells ? costs : fine_costmap_.of(costs, kLargestCell);
  goal_from_map_ =
      (Eigen::Translation2d(request.goal.position()) * Eigen::Rotation2Dd(request.goal.theta)).inverse();
  start_actions = lattice.fromAny({wanted.start.v, wanted.start.omega});
  time.reset(params, lattice, wanted.start.t, costmap);
}

}  // namespace lattice_planner
