// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/plan_conflict.h"

#include <algorithm>

namespace sarn_navigation {
namespace {

constexpr double kSampleStep = 0.1;  // [s] one cell at 0.5 m/s

enum class CellState { kFree, kStatic, kPeople };

CellState stateAt(const sarn::TrajectoryPoint& point, const sarn::TimedCostmapView& view,
                  lattice_planner::FootprintCheck* footprint) {
  const auto cell = view.geometry.cellAt(point.x, point.y);
  if (!cell) return CellState::kStatic;
  const std::size_t i = view.geometry.index(*cell);
  const auto forbidden = [](std::uint8_t cost) {
    return cost >= sarn::kInscribedObstacle && cost != sarn::kNoInformation;
  };
  if (forbidden(view.static_costs[i])) return CellState::kStatic;
  const int layer = view.layerAt(point.t);
  if (layer >= 0 && forbidden(view.layers[static_cast<std::size_t>(layer)][i])) return CellState::kPeople;
  if (footprint == nullptr || !footprint->active()) return CellState::kFree;
  if (!footprint->clearOfStatic(point.pose())) return CellState::kStatic;
  return footprint->clearOfPeople(point.pose(), layer) ? CellState::kFree : CellState::kPeople;
}

}  // namespace

std::optional<Conflict> firstConflict(const sarn::TimedTrajectory& trajectory,
                                      const sarn::TimedCostmapView& view, double from, double to,
                                      lattice_planner::FootprintCheck* footprint) {
  if (trajectory.empty()) return std::nullopt;
  const double end = std::min(to, std::max(from, trajectory.endTime()));
  bool leaving = true;
  for (double t = from; t <= end + 1e-9; t += kSampleStep) {
    const sarn::TrajectoryPoint point = trajectory.sample(t);
    const CellState state = stateAt(point, view, footprint);
    if (state == CellState::kFree) {
      leaving = false;
    } else if (!leaving) {
      return Conflict{point, state == CellState::kPeople};
    }
  }
  return std::nullopt;
}

}  // namespace sarn_navigation
