// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/trajectory_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lattice_planner {
namespace {

constexpr double kSampleStep = 0.1;     // [s]
constexpr double kDearestCost = 252.0;  // the largest cost that is not forbidden

double share(std::uint8_t cost) { return std::min(static_cast<double>(cost), kDearestCost) / kDearestCost; }

/// Rate [1/s] of the costs at one state.
double exposure(const PlannerParams& params, const sarn::TrajectoryPoint& point,
                const sarn::TimedCostmapView& costmap) {
  const auto cell = costmap.geometry.cellAt(point.x, point.y);
  if (!cell) return params.static_weight;
  const std::size_t i = costmap.geometry.index(*cell);
  const double static_part = params.static_weight * share(costmap.static_costs[i]);
  const double horizon =
      costmap.first_layer_time + static_cast<double>(costmap.layers.size()) * costmap.layer_duration;
  const int layer = costmap.layerAt(point.t);
  if (layer < 0 || point.t >= horizon) return static_part;
  const double social_part = params.social_weight * share(costmap.layers[static_cast<std::size_t>(layer)][i]);
  return params.combine_with_max ? std::max(static_part, social_part) : static_part + social_part;
}

}  // namespace

double trajectoryCost(const PlannerParams& params, const sarn::TimedTrajectory& trajectory,
                      const sarn::TimedCostmapView& costmap, double from) {
  if (trajectory.empty()) return 0.0;
  const double end = trajectory.endTime();
  double cost = 0.0;
  for (double t = std::max(from, trajectory.startTime()); t < end; t += kSampleStep) {
    const double dt = std::min(kSampleStep, end - t);
    const sarn::TrajectoryPoint point = trajectory.sample(t + 0.5 * dt);
    const double rate = params.time_weight + params.length_weight * std::abs(point.v) +
                        params.rotation_weight * std::abs(point.omega) + exposure(params, point, costmap);
    cost += rate * dt;
  }
  return cost;
}

}  // namespace lattice_planner
