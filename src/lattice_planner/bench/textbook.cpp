// SPDX-License-Identifier: BSD-3-Clause
#include "textbook.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include "sarn_common/angles.h"

namespace lattice_planner::bench {
namespace {

constexpr double kTimeCost = 200.0;  // an action
constexpr double kCellCost = 80.0;   // a cell's width
constexpr int kForbidden = 253;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double octile(const sarn::CellIndex& a, const sarn::CellIndex& b) {
  const int dx = std::abs(a.x - b.x);
  const int dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
}

}  // namespace

/// 8-connected Dijkstra over the static layer: the cell's cost and what a cell costs at full speed.
void Textbook::computeWavefront(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  const sarn::GridGeometry& g = costmap.geometry;
  const double neutral = kCellCost + kTimeCost * g.resolution / (params_.max_vel_x * params_.time_step);
  wavefront_.assign(g.size(), kInfinity);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::size_t goal = g.index(g.cellAtUnbounded(request.goal.x, request.goal.y));
  wavefront_[goal] = 0.0;
  open.push({0.0, goal});
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > wavefront_[index]) continue;
    const auto width = static_cast<std::size_t>(g.width);
    const sarn::CellIndex cell{static_cast<int>(index % width), static_cast<int>(index / width)};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const sarn::CellIndex to{cell.x + dx, cell.y + dy};
        if (!g.contains(to) || costmap.static_costs[g.index(to)] >= kForbidden) continue;
        const double next = cost + (neutral + costmap.static_costs[g.index(to)]) *
                                       (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0);
        if (next >= wavefront_[g.index(to)]) continue;
        wavefront_[g.index(to)] = next;
        open.push({next, g.index(to)});
      }
    }
  }
}

double Textbook::heuristic(const Node& node, const sarn::TimedCostmapView& costmap) const {
  const sarn::GridGeometry& g = costmap.geometry;
  return std::max(0.0, 0.9 * wavefront_[g.index(g.cellAtUnbounded(node.pose.x, node.pose.y))] - 450.0);
}

/// 200 + 80 * octile(first cell, last cell) + the dearer of static and social cost at nine points; people
/// where they are when the action begins.
std::optional<double> Textbook::costOf(const Node& from, const MotionPrimitive& action,
                                       const sarn::Pose2D& end, const PlanRequest& request,
                                       const sarn::TimedCostmapView& costmap) const {
  const sarn::GridGeometry& g = costmap.geometry;
  const auto last = g.cellAt(end.x, end.y);
  if (!last) return std::nullopt;
  const sarn::CellIndex first = g.cellAtUnbounded(from.pose.x, from.pose.y);
  const int layer = costmap.layerAt(request.start.t + from.step * params_.time_step);
  const auto costAt = [&](const sarn::CellIndex& cell) {
    const std::size_t i = g.index(cell);
    const int social = layer < 0 ? 0 : costmap.layers[static_cast<std::size_t>(layer)][i];
    return std::max<int>(costmap.static_costs[i], social);
  };
  double cost = kTimeCost + kCellCost * octile(first, *last) + costAt(first);
  for (const sarn::Pose2D& sample : action.samples) {
    const sarn::Pose2D p = from.pose * sample;
    const auto cell = g.cellAt(p.x, p.y);
    if (!cell || costAt(*cell) >= kForbidden) return std::nullopt;
    cost += costAt(*cell);
  }
  return cost;
}

std::uint64_t Textbook::keyOf(const Node& node, const PlanRequest& request,
                              const sarn::TimedCostmapView& costmap) const {
  const sarn::GridGeometry& g = costmap.geometry;
  const double turns = sarn::angleDifference(request.start.theta, node.pose.theta) / (2.0 * sarn::kPi);
  const long bin = (std::lround(turns * params_.heading_bins) + params_.heading_bins) % params_.heading_bins;
  const long last_step = std::max<long>(0, static_cast<long>(costmap.layers.size()) - 1);
  const auto at = [](auto value, unsigned shift) { return static_cast<std::uint64_t>(value) << shift; };
  return at(g.index(g.cellAtUnbounded(node.pose.x, node.pose.y)), 0) | at(bin, 32) | at(node.v, 42) |
         at(node.omega, 47) | at(std::min<long>(node.step, last_step), 52);
}

bool Textbook::isGoal(const Node& node, const sarn::Pose2D& goal) const {
  return lattice_.v(node.v) == 0.0 && lattice_.omega(node.omega) == 0.0 &&
         std::hypot(node.pose.x - goal.x, node.pose.y - goal.y) < params_.xy_goal_tolerance &&
         std::abs(sarn::angleDifference(node.pose.theta, goal.theta)) < params_.yaw_goal_tolerance;
}

std::optional<double> Textbook::solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                                      std::size_t max_expansions) {
  computeWavefront(request, costmap);
  std::vector<Node> nodes{
      {request.start.pose(), 0.0, lattice_.standingV(), lattice_.standingOmega(), 0, false}};
  std::unordered_map<std::uint64_t, std::size_t> known{{keyOf(nodes[0], request, costmap), 0}};
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({heuristic(nodes[0], costmap), 0});
  std::size_t expansions = 0;
  while (!open.empty() && expansions < max_expansions) {
    const std::size_t id = open.top().second;
    open.pop();
    if (nodes[id].closed) continue;
    nodes[id].closed = true;
    const Node from = nodes[id];
    if (isGoal(from, request.goal)) return from.g;
    ++expansions;
    for (const MotionPrimitive& action : lattice_.from(from.v, from.omega)) {
      const sarn::Pose2D end = from.pose * action.samples.back();
      const std::optional<double> cost = costOf(from, action, end, request, costmap);
      if (!cost) continue;
      const Node next{end, from.g + *cost, action.v, action.omega, from.step + 1, false};
      const double h = heuristic(next, costmap);
      if (h == kInfinity) continue;
      const auto [place, fresh] = known.try_emplace(keyOf(next, request, costmap), nodes.size());
      if (!fresh && nodes[place->second].g <= next.g) continue;
      if (!fresh) nodes[place->second].closed = true;  // superseded
      place->second = nodes.size();
      nodes.push_back(next);
      open.push({next.g + h, nodes.size() - 1});
    }
  }
  return std::nullopt;
}

}  // namespace lattice_planner::bench
