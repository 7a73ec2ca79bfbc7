// SPDX-License-Identifier: BSD-3-Clause
#include "textbook.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sarn_common/angles.h"

namespace lattice_planner::bench {

double Textbook::heuristic(const AncestorTask::State& state) const {
  return std::max(0.0, 0.9 * task_.wavefront(state) - 450.0);
}

/// Heading bins are centred on the start's heading, which the lattice's headings are offset by.
std::uint64_t Textbook::keyOf(const AncestorTask::State& state) const {
  const int bins = task_.params().heading_bins;
  const double turns = sarn::angleDifference(task_.start().pose.theta, state.pose.theta) / (2.0 * sarn::kPi);
  const long bin = (std::lround(turns * bins) + bins) % bins;
  const auto at = [](auto value, unsigned shift) { return static_cast<std::uint64_t>(value) << shift; };
  return at(task_.cellOf(state), 0) | at(bin, 32) | at(state.v, 42) | at(state.omega, 47) |
         at(std::min(state.step, task_.lastLayer()), 52);
}

std::optional<double> Textbook::solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                                      std::size_t max_expansions) {
  task_.reset(request, costmap);
  std::vector<Node> nodes{{task_.start()}};
  std::unordered_map<std::uint64_t, std::size_t> known{{keyOf(nodes[0].state), 0}};
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({heuristic(nodes[0].state), 0});
  std::size_t expansions = 0;
  while (!open.empty() && expansions < max_expansions) {
    const std::size_t id = open.top().second;
    open.pop();
    if (nodes[id].closed) continue;
    nodes[id].closed = true;
    const Node from = nodes[id];
    if (task_.isGoal(from.state)) return from.g;
    ++expansions;
    for (const MotionPrimitive& action : task_.actions(from.state)) {
      const AncestorTask::State next = AncestorTask::after(from.state, action);
      const std::optional<double> cost = task_.costOf(from.state, action, next.pose);
      if (!cost) continue;
      const double g = from.g + *cost;
      const double h = heuristic(next);
      if (!std::isfinite(h)) continue;
      const auto [place, fresh] = known.try_emplace(keyOf(next), nodes.size());
      if (!fresh && nodes[place->second].g <= g) continue;
      if (!fresh) nodes[place->second].closed = true;  // superseded
      place->second = nodes.size();
      nodes.push_back({next, g, false});
      open.push({g + h, nodes.size() - 1});
    }
  }
  return std::nullopt;
}

}  // namespace lattice_planner::bench
