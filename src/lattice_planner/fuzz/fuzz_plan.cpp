// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a map, people and a request: the planner must answer with one outcome, and every trajectory
// must be one that the robot can drive, through free cells, from the start to a stand; a complete one ends at
// the goal.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "lattice_planner/lattice_planner.h"
#include "sarn_common/angles.h"
#include "sarn_common/cost_values.h"

namespace {

/// Reads values off the bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  /// Mostly within [low, high]; one in 256 is any double: NaN, infinite, huge.
  double number(double low, double high) {
    if (byte() == 255) {
      std::uint64_t raw = 0;
      for (int i = 0; i < 8; ++i) raw = raw << 8U | byte();
      double value = 0.0;
      std::memcpy(&value, &raw, sizeof value);
      return value;
    }
    return low + (high - low) * (byte() * 256.0 + byte()) / 65535.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

void check(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "a plan is wrong: %s\n", what);
  std::abort();
}

constexpr double kRounding = 1e-6;

/// From one point to the next in one time step, within the limits; a start that is too fast may only slow
/// down.
void checkAction(const sarn::TrajectoryPoint& from, const sarn::TrajectoryPoint& to,
                 const lattice_planner::PlannerParams& params, bool from_start) {
  check(std::isfinite(to.x) && std::isfinite(to.y) && std::isfinite(to.theta), "not finite");
  check(std::abs(to.t - from.t - params.time_step) < kRounding * (1.0 + std::abs(to.t)), "time");
  check(to.v <= params.max_vel_x + kRounding && to.v >= params.min_vel_x - kRounding, "speed");
  check(std::abs(to.omega) <= params.max_vel_theta + kRounding, "angular speed");
  const bool too_fast = from_start && (from.v > params.max_vel_x + params.acc_lim_x * params.time_step ||
                                       from.v < params.min_vel_x - params.acc_lim_x * params.time_step);
  const bool turns_too_fast =
      from_start && std::abs(from.omega) > params.max_vel_theta + params.acc_lim_theta * params.time_step;
  check(too_fast || std::abs(to.v - from.v) <= params.acc_lim_x * params.time_step + kRounding,
        "acceleration");
  check(turns_too_fast ||
            std::abs(to.omega - from.omega) <= params.acc_lim_theta * params.time_step + kRounding,
        "angular acceleration");
  const sarn::Pose2D end =
      sarn::advance(from.pose(), {0.5 * (from.v + to.v), 0.5 * (from.omega + to.omega)}, params.time_step);
  const double far = kRounding * (1.0 + std::abs(from.x) + std::abs(from.y) + std::abs(from.v));
  check(std::abs(from.omega) > 1e6 || std::hypot(end.x - to.x, end.y - to.y) < far, "jump");
}

/// No point of the plan is on a cell that is lethal in the static layer, or unknown where that is forbidden,
/// unless the robot started inside a forbidden place and leaves it.
void checkCells(const sarn::TimedTrajectory& plan, const sarn::TimedCostmapView& view,
                const lattice_planner::PlannerParams& params) {
  const auto forbidden = [&](const sarn::TrajectoryPoint& p) {
    const auto cell = view.geometry.cellAt(p.x, p.y);
    if (!cell) return true;
    const int cost = view.static_costs[view.geometry.index(*cell)];
    return cost == sarn::kNoInformation ? !params.allow_unknown : cost >= params.forbidden_cost;
  };
  if (forbidden(plan.points.front())) return;
  for (const sarn::TrajectoryPoint& p : plan.points) check(!forbidden(p), "forbidden cell");
}

void checkResult(const lattice_planner::PlanResult& result, const lattice_planner::PlanRequest& request,
                 const sarn::TimedCostmapView& view, const lattice_planner::PlannerParams& params) {
  check(lattice_planner::toString(result.status) != nullptr, "status without a name");
  const auto& points = result.trajectory.points;
  if (lattice_planner::isDrivable(result.status)) check(!points.empty(), "nothing to drive");
  if (points.empty()) return;
  check(points.front().x == request.start.x && points.front().y == request.start.y, "other start");
  check(points.back().v == 0.0 && points.back().omega == 0.0, "ends moving");
  for (std::size_t i = 1; i < points.size(); ++i) checkAction(points[i - 1], points[i], params, i == 1);
  if (!lattice_planner::isDrivable(result.status)) return;  // braking at once is the least harm
  checkCells(result.trajectory, view, params);
  if (result.status != lattice_planner::PlanStatus::kComplete) return;
  const sarn::TrajectoryPoint& end = points.back();
  check(std::hypot(end.x - request.goal.x, end.y - request.goal.y) < params.xy_goal_tolerance + kRounding,
        "not at the goal");
  check(std::abs(sarn::angleDifference(sarn::wrapAngle(end.theta), sarn::wrapAngle(request.goal.theta))) <
            params.yaw_goal_tolerance + kRounding,
        "other heading than the goal");
  check(result.bound >= 1.0 && std::isfinite(result.cost) && result.cost >= 0.0, "cost or bound");
}

lattice_planner::PlannerParams small() {
  lattice_planner::PlannerParams params;
  params.table_radius = 0.4;
  params.max_expansions = 2000;
  return params;
}

lattice_planner::LatticePlanner longRobot() {
  lattice_planner::PlannerParams params = small();
  params.footprint = "[[0.3, 0.12], [-0.2, 0.12], [-0.2, -0.12], [0.3, -0.12]]";
  params.allow_unknown = true;
  return lattice_planner::LatticePlanner(params);
}

/// Charges as the ancestor does and improves in columns.
lattice_planner::LatticePlanner likeTheAncestor() {
  lattice_planner::PlannerParams params = small();
  params.charge_cells = params.combine_with_max = true;
  params.forget_moving_people = false;
  params.promising_expansions = 2000;
  params.least_improvement = 50;
  return lattice_planner::LatticePlanner(params);
}

lattice_planner::LatticePlanner reversing() {
  lattice_planner::PlannerParams params = small();
  params.min_vel_x = -0.25;
  return lattice_planner::LatticePlanner(params);
}

/// For all inputs: nothing may be left over from the last one.
lattice_planner::LatticePlanner& planner(std::uint8_t which) {
  static std::array<lattice_planner::LatticePlanner, 4> all = {lattice_planner::LatticePlanner(small()),
                                                               longRobot(), likeTheAncestor(), reversing()};
  return all[which % all.size()];
}

/// A person's disc and the cost around it.
void paintPerson(std::vector<std::uint8_t>& layer, const sarn::GridGeometry& g, double x, double y) {
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      const double distance = (g.center({column, row}) - Eigen::Vector2d(x, y)).norm();
      if (!(distance < 0.6)) continue;
      std::uint8_t& cell = layer[g.index({column, row})];
      cell = std::max<std::uint8_t>(cell, distance < 0.3 ? sarn::kLethalObstacle : 100);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  sarn::TimedCostmapView view;
  view.geometry = {bytes.byte() % 48, bytes.byte() % 48, 0.05 * (1 + bytes.byte() % 4),
                   bytes.number(-2.0, 2.0), bytes.number(-2.0, 2.0)};
  const std::size_t cells = view.geometry.size();
  const auto paint = [&](std::vector<std::uint8_t>& layer) {
    layer.assign(cells + 1, 0);
    for (int spot = bytes.byte() % 12; spot > 0 && cells > 0; --spot) {
      const std::size_t begin = (bytes.byte() * 256U + bytes.byte()) % cells;
      const std::uint8_t cost = bytes.byte();
      for (std::size_t i = begin; i < cells && i < begin + 8U; ++i) layer[i] = cost;
    }
  };
  std::vector<std::vector<std::uint8_t>> layers(1 + bytes.byte() % 6);
  for (auto& layer : layers) paint(layer);
  for (int person = bytes.byte() % 4; person > 0; --person) {  // walks through the layers
    const double px = bytes.number(-2.0, 8.0), py = bytes.number(-2.0, 8.0);
    const double vx = bytes.number(-1.0, 1.0), vy = bytes.number(-1.0, 1.0);
    for (std::size_t i = 1; i < layers.size(); ++i) {
      const double t = 0.5 * static_cast<double>(i);
      paintPerson(layers[i], view.geometry, px + t * vx, py + t * vy);
    }
  }
  view.static_costs = bytes.byte() == 255 ? nullptr : layers.front().data();
  for (std::size_t i = 1; i < layers.size(); ++i) view.layers.push_back(layers[i].data());
  view.first_layer_time = bytes.number(-5.0, 5.0);
  view.layer_duration = bytes.number(0.1, 1.0);
  lattice_planner::PlanRequest request;
  const sarn::GridGeometry& g = view.geometry;
  const auto x = [&] { return bytes.number(g.origin_x - 0.1, g.origin_x + g.width * g.resolution + 0.1); };
  const auto y = [&] { return bytes.number(g.origin_y - 0.1, g.origin_y + g.height * g.resolution + 0.1); };
  request.start = {x(),
                   y(),
                   bytes.number(-7.0, 7.0),
                   bytes.number(-1.0, 1.0),
                   bytes.number(-2.0, 2.0),
                   bytes.number(-5.0, 5.0)};
  request.goal = {x(), y(), bytes.number(-7.0, 7.0)};
  request.time_limit = 60.0;
  lattice_planner::LatticePlanner& asked = planner(bytes.byte());
  checkResult(asked.plan(request, view), request, view, asked.params());
  return 0;
}
