// SPDX-License-Identifier: BSD-3-Clause
#include "motion_check.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "sarn_common/angles.h"

namespace lattice_planner {

MotionCheck::MotionCheck(const SearchTask& task)
    : task_(task), footprint_(parseFootprint(task.params.footprint), task.params.allow_unknown) {}

void MotionCheck::reset() {
  const sarn::TrajectoryPoint& start = task_.request.start;
  escape_.reset(task_.costmap, task_.cell_costs.forbidden_static, task_.cell_costs.forbidden_social,
                task_.costmap.geometry.cellAtUnbounded(start.x, start.y), start.t,
                task_.params.escape_radius);
  starts_inside_ = escape_.active();
  if (!footprint_.active()) return;
  footprint_.reset(task_.costmap);
  starts_inside_ = starts_inside_ || !footprint_.clearOfStatic(start.pose()) ||
                   !footprint_.clearOfPeople(start.pose(), task_.costmap.layerAt(start.t));
}

bool MotionCheck::goalOccupied() {
  if (!footprint_.active()) return false;
  const sarn::Pose2D& goal = task_.request.goal;
  const double reach = task_.params.xy_goal_tolerance;
  const double step = 0.5 * task_.costmap.geometry.resolution;
  constexpr int kHeadings = 4;  // on each side
  const int cells = static_cast<int>(reach / step);
  for (int y = -cells; y <= cells; ++y) {
    for (int x = -cells; x <= cells; ++x) {
      if (std::hypot(x, y) * step >= reach) continue;
      const auto cell = task_.costmap.geometry.cellAt(goal.x + x * step, goal.y + y * step);
      if (!cell) continue;
      const std::uint8_t cost = task_.costmap.static_costs[task_.costmap.geometry.index(*cell)];
      if (task_.cell_costs.forbidden_static[cost]) continue;
      for (int h = -kHeadings; h <= kHeadings; ++h) {
        const double turn = std::min(task_.params.yaw_goal_tolerance, sarn::kPi) * h / kHeadings;
        if (footprint_.clearOfStatic({goal.x + x * step, goal.y + y * step, goal.theta + turn})) return false;
      }
    }
  }
  return true;
}

bool MotionCheck::advance(const SearchState& from, const MotionPrimitive& action, double c, double s,
                          SearchState& next) const {
  const sarn::Pose2D& end = action.samples.back();
  next.x = from.x + c * end.x - s * end.y;
  next.y = from.y + s * end.x + c * end.y;
  const sarn::GridGeometry& g = task_.costmap.geometry;
  const auto cell = g.cellAt(next.x, next.y);  // a start of any speed may land beyond all indices
  next.g = from.g + static_cast<double>(action.base_cost);
  if (cell && task_.params.charge_cells) {
    next.g += cellsInsteadOfLength(g.cellAtUnbounded(from.x, from.y), *cell, action);
  }
  next.theta = sarn::wrapAngle(from.theta + action.dtheta);
  next.v = action.v;
  next.omega = action.omega;
  next.step = from.step + 1;
  next.escaping = from.escaping;
  return cell.has_value();
}

/// What the octile distance between two cells costs more than the action's length.
double MotionCheck::cellsInsteadOfLength(const sarn::CellIndex& from, const sarn::CellIndex& to,
                                         const MotionPrimitive& action) const {
  const int dx = std::abs(to.x - from.x);
  const int dy = std::abs(to.y - from.y);
  const double cells = std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
  return task_.params.length_weight *
         (cells * task_.costmap.geometry.resolution - static_cast<double>(action.length));
}

bool MotionCheck::traverse(const SearchState& from, const MotionPrimitive& action, double c, double s,
                           float& cost, bool& escaping) {
  const sarn::GridGeometry& g = task_.costmap.geometry;
  const bool charge_cells = task_.params.charge_cells;
  sarn::CellIndex last = g.cellAtUnbounded(from.x, from.y);
  sarn::Pose2D last_pose{from.x, from.y, from.theta};
  const int layer_at_start = charge_cells ? task_.time.layerOf(from.step, -1) : -1;
  if (charge_cells) cost += exposure(g.index(last), layer_at_start);
  for (int k = 0; k < task_.lattice.samplesPerStep(); ++k) {
    const sarn::Pose2D& sample = action.samples[static_cast<std::size_t>(k)];
    const double x = from.x + c * sample.x - s * sample.y;
    const double y = from.y + s * sample.x + c * sample.y;
    const auto cell = g.cellAt(x, y);
    if (!cell) return false;
    const int layer = charge_cells ? layer_at_start : task_.time.layerOf(from.step, k);
    const std::size_t index = g.index(*cell);
    const std::uint8_t static_cost = task_.costmap.static_costs[index];
    const std::uint8_t social_cost =
        layer < 0 ? sarn::kFreeSpace : task_.costmap.layers[static_cast<std::size_t>(layer)][index];
    bool inside =
        task_.cell_costs.forbidden_static[static_cost] || task_.cell_costs.forbidden_social[social_cost];
    if (inside && (!escaping || !escape_.allows(last, *cell, layer))) return false;
    if (footprint_.active()) {
      const sarn::Pose2D pose{x, y, from.theta + sample.theta};
      if (!footprintAllowed(last_pose, pose, layer, escaping, inside)) return false;
      last_pose = pose;
    }
    escaping = escaping && inside;
    cost += exposure(index, layer);
    last = *cell;
  }
  return true;
}

bool MotionCheck::footprintAllowed(const sarn::Pose2D& from, const sarn::Pose2D& to, int layer, bool escaping,
                                   bool& touches) {
  if (!escaping) return footprint_.clearOfStatic(to) && footprint_.clearOfPeople(to, layer);
  const int statically = footprint_.touchedStatic(to);
  const int socially = footprint_.touchedPeople(to, layer);
  if (statically == 0 && socially == 0) return true;
  touches = true;
  if (!escape_.inWindow(task_.costmap.geometry.cellAtUnbounded(to.x, to.y))) return false;
  return (statically == 0 || statically <= footprint_.touchedStatic(from)) &&
         (socially == 0 || socially <= footprint_.touchedPeople(from, layer));
}

bool MotionCheck::standsFreeOfPeople(const SearchState& state) {
  const auto cell = task_.costmap.geometry.cellAt(state.x, state.y);
  const int last_layer = task_.time.lastLayer();
  if (!cell || last_layer < 0) return cell.has_value();
  const std::size_t index = task_.costmap.geometry.index(*cell);
  for (int layer = task_.costmap.layerAt(task_.timeOf(state)); layer <= last_layer; ++layer) {
    const std::uint8_t cost = task_.costmap.layers[static_cast<std::size_t>(layer)][index];
    if (task_.cell_costs.forbidden_social[cost]) return false;
    if (footprint_.active() && !footprint_.clearOfPeople({state.x, state.y, state.theta}, layer))
      return false;
  }
  return true;
}

}  // namespace lattice_planner
