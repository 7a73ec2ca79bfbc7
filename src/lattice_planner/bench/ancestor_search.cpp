// SPDX-License-Identifier: BSD-3-Clause
#include "ancestor_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sarn_common/angles.h"

namespace lattice_planner::bench {
namespace {

constexpr int kLastStep = 14;  // of 0.5 s: from 7 s on all times are one

}  // namespace

std::uint64_t AncestorSearch::keyOf(const AncestorTask::State& state) const {
  const double turns = state.pose.theta / (2.0 * sarn::kPi);
  const long bin = std::lround((turns - std::floor(turns)) * task_.params().heading_bins);  // 0 .. 16
  const auto at = [](auto value, unsigned shift) { return static_cast<std::uint64_t>(value) << shift; };
  return at(task_.cellOf(state), 0) | at(bin, 32) | at(state.v, 42) | at(state.omega, 47) |
         at(std::min(state.step, kLastStep), 52);
}

std::optional<AncestorSearch::Plan> AncestorSearch::solve(const PlanRequest& request,
                                                          const sarn::TimedCostmapView& costmap,
                                                          std::size_t max_expansions) {
  task_.reset(request, costmap);
  std::vector<Node> nodes{{task_.start()}};
  std::unordered_set<std::uint64_t> generated{keyOf(nodes[0].state)};
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({task_.wavefront(nodes[0].state), 0});
  std::size_t expansions = 0;
  while (!open.empty() && expansions < max_expansions) {
    const Node from = nodes[open.top().second];
    open.pop();
    ++expansions;
    for (const MotionPrimitive& action : task_.actions(from.state)) {
      const AncestorTask::State next = AncestorTask::after(from.state, action);
      const std::optional<double> cost = task_.costOf(from.state, action, next.pose);
      if (!cost) continue;
      const double h = task_.wavefront(next);
      if (!std::isfinite(h) || !generated.insert(keyOf(next)).second) continue;
      const double g = from.g + *cost;
      if (task_.isGoal(next)) return Plan{g, expansions};
      nodes.push_back({next, g});
      open.push({g + h, nodes.size() - 1});
    }
  }
  return std::nullopt;
}

}  // namespace lattice_planner::bench
