// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/yield_spot.h"

#include <algorithm>
#include <cmath>

#include "sarn_navigation/reachable_area.h"

namespace sarn_navigation {
namespace {

constexpr std::uint8_t kQuietCost = 60;        // a spot's static cost stays below: not glued to a wall
constexpr std::uint8_t kUndisturbedCost = 30;  // and its social cost in every layer
constexpr double kSpotMargin = 0.25;           // [m] beyond yield_distance

bool undisturbed(std::size_t cell, const sarn::TimedCostmapView& view) {
  return std::all_of(view.layers.begin(), view.layers.end(),
                     [&](const std::uint8_t* layer) { return layer[cell] < kUndisturbedCost; });
}

}  // namespace

std::optional<sarn::Pose2D> findYieldSpot(const sarn::Pose2D& robot, const BlockedPerson& person,
                                          const sarn::TimedCostmapView& view, const NavigatorParams& params) {
  const sarn::Grid<float> lengths = pathLengths(view, robot.position(), params.yield_search_radius);
  const double clearance = params.yield_distance + kSpotMargin;
  float best_length = kUnreachable;
  std::optional<Eigen::Vector2d> best;
  for (int y = 0; y < view.geometry.height; ++y) {
    for (int x = 0; x < view.geometry.width; ++x) {
      const std::size_t i = view.geometry.index({x, y});
      if (lengths.cells[i] >= best_length || view.static_costs[i] >= kQuietCost) continue;
      const Eigen::Vector2d p = view.geometry.center({x, y});
      if (distanceToWay(p, person) < clearance || !undisturbed(i, view)) continue;
      best_length = lengths.cells[i];
      best = p;
    }
  }
  if (!best) return std::nullopt;
  const Eigen::Vector2d direction = person.velocity.normalized();
  const Eigen::Vector2d foot = person.position + direction * direction.dot(*best - person.position);
  const Eigen::Vector2d look = foot - *best;
  return sarn::Pose2D{best->x(), best->y(),
                      look.norm() > 1e-6 ? std::atan2(look.y(), look.x()) : robot.theta};
}

}  // namespace sarn_navigation
