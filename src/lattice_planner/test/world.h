// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "lattice_planner/lattice_planner.h"
#include "sarn_common/angles.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner::testing {

/// A tiny world drawn by hand: '.' free, '#' lethal, 'i' inscribed, '?' unknown, '1'..'9' costs of 25 a step.
/// The first row drawn is the largest y. Time layers are added empty and painted with discs.
class World {
 public:
  World(const std::vector<std::string>& rows, double resolution) {
    view_.geometry = {static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), resolution, 0.0,
                      0.0};
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
      for (const char c : *row) static_costs_.push_back(costOf(c));
    }
    view_.static_costs = static_costs_.data();
  }

  /// Free room of width x height [m].
  static World room(double width, double height, double resolution = 0.05) {
    const auto columns = static_cast<std::size_t>(std::lround(width / resolution));
    const auto rows = static_cast<std::size_t>(std::lround(height / resolution));
    return World(std::vector<std::string>(rows, std::string(columns, '.')), resolution);
  }

  void addLayers(int count, double duration) {
    view_.layer_duration = duration;
    for (int i = 0; i < count; ++i) {
      layers_.emplace_back(view_.geometry.size(), sarn::kFreeSpace);
      view_.layers.push_back(layers_.back().data());
    }
  }

  /// Paints a disc into layer i.
  void paint(int layer, double x, double y, double radius, std::uint8_t cost = sarn::kLethalObstacle) {
    paintOn(layers_[static_cast<std::size_t>(layer)], x, y, radius, cost);
  }
  void paintStatic(double x, double y, double radius, std::uint8_t cost) {
    paintOn(static_costs_, x, y, radius, cost);
  }
  void setStatic(const sarn::CellIndex& cell, std::uint8_t cost) {
    static_costs_[view_.geometry.index(cell)] = cost;
  }

  /// A forbidden disc and a cost ring around a person who walks from (x, y) with (vx, vy).
  void walk(double x, double y, double vx, double vy, double radius = 0.3) {
    for (int i = 0; i < static_cast<int>(layers_.size()); ++i) {
      for (double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double t = view_.first_layer_time + (i + share) * view_.layer_duration;
        paint(i, x + vx * t, y + vy * t, radius + 0.3, 100);
      }
      for (double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double t = view_.first_layer_time + (i + share) * view_.layer_duration;
        paint(i, x + vx * t, y + vy * t, radius);
      }
    }
  }

  [[nodiscard]] const sarn::TimedCostmapView& view() const { return view_; }
  [[nodiscard]] sarn::TimedCostmapView& view() { return view_; }

  /// Highest cost, static or of the people then, at a place at a time.
  [[nodiscard]] int costAt(double x, double y, double t) const {
    const auto cell = view_.geometry.cellAt(x, y);
    if (!cell) return 256;
    const std::size_t index = view_.geometry.index(*cell);
    int cost = view_.static_costs[index];
    if (view_.layerAt(t) >= 0) {
      cost = std::max<int>(cost, view_.layers[static_cast<std::size_t>(view_.layerAt(t))][index]);
    }
    return cost;
  }

 private:
  static std::uint8_t costOf(char c) {
    if (c == '#') return sarn::kLethalObstacle;
    if (c == 'i') return sarn::kInscribedObstacle;
    if (c == '?') return sarn::kNoInformation;
    if (c >= '1' && c <= '9') return static_cast<std::uint8_t>(25 * (c - '0'));
    return sarn::kFreeSpace;
  }
  void paintOn(std::vector<std::uint8_t>& cells, double x, double y, double radius, std::uint8_t cost) {
    for (int row = 0; row < view_.geometry.height; ++row) {
      for (int column = 0; column < view_.geometry.width; ++column) {
        if ((view_.geometry.center({column, row}) - Eigen::Vector2d(x, y)).norm() > radius) continue;
        std::uint8_t& cell = cells[view_.geometry.index({column, row})];
        cell = std::max(cell, cost);
      }
    }
  }
  sarn::TimedCostmapView view_;
  std::vector<std::uint8_t> static_costs_;
  std::deque<std::vector<std::uint8_t>> layers_;
};

inline PlanRequest request(const sarn::Pose2D& start, const sarn::Pose2D& goal, double time_limit = 600.0) {
  return {{start.x, start.y, start.theta, 0.0, 0.0, 0.0}, goal, time_limit};
}

/// What is wrong with a trajectory for this planner; empty when nothing is.
inline std::vector<std::string> faults(const sarn::TimedTrajectory& trajectory, const PlanRequest& request,
                                       const PlannerParams& params, const World& world,
                                       double allowed_until = -1.0) {
  std::vector<std::string> all;
  const auto fault = [&all](const std::string& what, double t) {
    all.push_back(what + " at t = " + std::to_string(t));
  };
  if (trajectory.empty()) return {"empty"};
  const auto& points = trajectory.points;
  const auto& first = points.front();
  if (first.x != request.start.x || first.y != request.start.y || first.t != request.start.t)
    fault("other start", first.t);
  if (points.back().v != 0.0 || points.back().omega != 0.0) fault("ends moving", points.back().t);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& a = points[i - 1];
    const auto& b = points[i];
    const double dt = b.t - a.t;
    if (std::abs(dt - params.time_step) > 1e-9) fault("time step", a.t);
    if (std::abs(b.v - a.v) > params.acc_lim_x * dt + 1e-9) fault("acceleration", a.t);
    if (std::abs(b.omega - a.omega) > params.acc_lim_theta * dt + 1e-9) fault("angular acceleration", a.t);
    if (b.v > params.max_vel_x + 1e-9 || b.v < params.min_vel_x - 1e-9) fault("speed", b.t);
    if (std::abs(b.omega) > params.max_vel_theta + 1e-9) fault("angular speed", b.t);
    const sarn::Pose2D end = sarn::advance(a.pose(), {0.5 * (a.v + b.v), 0.5 * (a.omega + b.omega)}, dt);
    if (std::hypot(end.x - b.x, end.y - b.y) > 1e-9) fault("jump", b.t);
    if (std::abs(sarn::angleDifference(end.theta, b.theta)) > 1e-9) fault("turned", b.t);
    // The samples the planner promises to have checked.
    const int samples = std::max(
        1, static_cast<int>(
               std::ceil(params.max_vel_x * params.time_step / params.collision_check_distance - 1e-9)));
    for (int k = 1; k <= samples; ++k) {
      const double t = a.t + dt * k / samples;
      const sarn::Pose2D p = sarn::advance(a.pose(), {0.5 * (a.v + b.v), 0.5 * (a.omega + b.omega)}, t - a.t);
      if (t > allowed_until && world.costAt(p.x, p.y, t) >= params.forbidden_cost) fault("collision", t);
    }
  }
  return all;
}

/// A corridor along x with a wall across it that leaves a doorway of 0.5 m in the middle.
inline World doorway() {
  World world = World::room(4.0, 1.5);
  for (double y = 0.025; y < 1.5; y += 0.05) {
    if (y > 0.5 && y < 1.0) continue;
    for (double x = 1.925; x < 2.1; x += 0.05) {
      world.setStatic(*world.view().geometry.cellAt(x, y), sarn::kLethalObstacle);
    }
  }
  return world;
}

}  // namespace lattice_planner::testing
