// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/planner_params.h"
#include "world.h"

namespace lattice_planner::testing {

/// Plain Dijkstra over the lattice, written anew and without any heuristic: what the planner is measured
/// against. States within `merge` [m] of each other with the same heading, speeds and step are one; headings
/// are exact.
class Oracle {
 public:
  struct State {
    sarn::Pose2D pose;
    int v;
    int omega;
    int step;
  };
  struct Solution {
    double cost = std::numeric_limits<double>::infinity();
    std::vector<State> states;
    std::vector<double> costs_to_go;
  };

  Oracle(const PlannerParams& params, const World& world, double merge)
      : params_(params), lattice_(params), world_(world), merge_(merge) {}

  [[nodiscard]] Solution solve(const PlanRequest& request, double worst = 1e9) const {
    std::vector<Node> nodes;
    std::unordered_map<Key, double> best;
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    nodes.push_back(
        {{request.start.pose(), indexOf(request.start.v, lattice_.forwardSpeeds(), &MotionLattice::v),
          indexOf(request.start.omega, lattice_.angularSpeeds(), &MotionLattice::omega), 0},
         0.0,
         0});
    open.push({0.0, 0});
    while (!open.empty()) {
      const auto [cost, id] = open.top();
      open.pop();
      const Node node = nodes[id];
      if (cost > best.try_emplace(keyOf(node.state, request), cost).first->second) continue;
      if (isGoal(node.state, request.goal)) return trace(nodes, id);
      for (const MotionPrimitive& action : lattice_.from(node.state.v, node.state.omega)) {
        const std::optional<double> exposure = exposureOf(node.state, action, request.start.t);
        if (!exposure) continue;
        const sarn::Pose2D end = node.state.pose * action.samples.back();
        const Node next{{end, action.v, action.omega, node.state.step + 1},
                        cost + static_cast<double>(action.base_cost) + *exposure,
                        id};
        if (next.cost > worst) continue;
        const auto [known, fresh] = best.try_emplace(keyOf(next.state, request), next.cost);
        if (!fresh && known->second <= next.cost) continue;
        known->second = next.cost;
        nodes.push_back(next);
        open.push({next.cost, nodes.size() - 1});
      }
    }
    return {};
  }

 private:
  using Key = std::uint64_t;
  struct Node {
    State state;
    double cost;
    std::size_t parent;
  };

  /// Of a speed of the lattice.
  [[nodiscard]] int indexOf(double speed, int count, double (MotionLattice::*value)(int) const) const {
    for (int i = 0; i < count; ++i) {
      if (std::abs((lattice_.*value)(i)-speed) < 1e-9) return i;
    }
    throw std::invalid_argument("the start's speed is not one of the lattice");
  }

  [[nodiscard]] Key keyOf(const State& s, const PlanRequest& request) const {
    const bool timeless = world_.view().layers.empty();
    const double turn = sarn::angleDifference(request.start.theta, s.pose.theta);
    const auto bits = [](long value, unsigned shift) { return static_cast<Key>(value) << shift; };
    return bits(std::lround(s.pose.x / merge_), 0) | bits(std::lround(s.pose.y / merge_), 12) |
           bits(std::lround((turn + 4.0) / 1e-3), 24) | bits(s.v, 40) | bits(s.omega, 46) |
           bits(timeless ? 0 : s.step, 52);
  }

  [[nodiscard]] bool isGoal(const State& s, const sarn::Pose2D& goal) const {
    return lattice_.v(s.v) == 0.0 && lattice_.omega(s.omega) == 0.0 &&
           std::hypot(s.pose.x - goal.x, s.pose.y - goal.y) < params_.xy_goal_tolerance &&
           std::abs(sarn::angleDifference(s.pose.theta, goal.theta)) < params_.yaw_goal_tolerance;
  }

  /// Static and social cost over the samples of one action; nothing when it is forbidden.
  [[nodiscard]] std::optional<double> exposureOf(const State& s, const MotionPrimitive& action,
                                                 double start) const {
    const sarn::TimedCostmapView& view = world_.view();
    const double share = params_.time_step / lattice_.samplesPerStep();
    double total = 0.0;
    for (int k = 0; k < lattice_.samplesPerStep(); ++k) {
      const sarn::Pose2D p = s.pose * action.samples[static_cast<std::size_t>(k)];
      const auto cell = view.geometry.cellAt(p.x, p.y);
      if (!cell) return std::nullopt;
      const double t = start + (s.step + (k + 1.0) / lattice_.samplesPerStep()) * params_.time_step;
      const std::size_t index = view.geometry.index(*cell);
      const int static_cost = view.static_costs[index];
      const int layer = view.layerAt(t);
      const int social_cost = layer < 0 ? 0 : view.layers[static_cast<std::size_t>(layer)][index];
      if (static_cost >= params_.forbidden_cost || social_cost >= params_.forbidden_cost) return std::nullopt;
      total += share * (params_.static_weight * static_cost + params_.social_weight * social_cost) / 252.0;
    }
    return total;
  }

  [[nodiscard]] static Solution trace(const std::vector<Node>& nodes, std::size_t id) {
    Solution solution;
    solution.cost = nodes[id].cost;
    for (std::size_t i = id;; i = nodes[i].parent) {
      solution.states.push_back(nodes[i].state);
      solution.costs_to_go.push_back(solution.cost - nodes[i].cost);
      if (i == 0) return solution;
    }
  }

  PlannerParams params_;
  MotionLattice lattice_;
  const World& world_;
  double merge_;
};

}  // namespace lattice_planner::testing
