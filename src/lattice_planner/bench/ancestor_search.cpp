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

long AncestorSearch::headingBin(double theta) const {
  const double turns = theta / (2.0 * sarn::kPi);
  return std::lround((turns - std::floor(turns)) * task_.params().heading_bins);
}

std::uint64_t AncestorSearch::keyOf(const AncestorTask::State& state) const {
  const auto at = [](auto value, unsigned shift) { return static_cast<std::uint64_t>(value) << shift; };
  return at(task_.cellOf(state), 0) | at(headingBin(state.pose.theta), 32) | at(state.v, 42) |
         at(state.omega, 47) | at(std::min(state.step, kLastStep), 52);
}

AncestorSearch::Plan AncestorSearch::solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                                           std::size_t max_expansions) {
  task_.reset(request, costmap);
  std::vector<Node> nodes{{task_.start()}};
  std::unordered_set<std::uint64_t> generated{keyOf(nodes[0].state)};
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({task_.wavefront(nodes[0].state), 0});
  std::size_t expansions = 0;
  while (!open.empty()) {
    const std::size_t id = open.top().second;
    if (expansions == max_expansions) return planTo(nodes, id, expansions);
    const Node from = nodes[id];
    open.pop();
    ++expansions;
    for (const MotionPrimitive& action : task_.actions(from.state)) {
      const AncestorTask::State next = AncestorTask::after(from.state, action);
      const std::optional<double> cost = task_.costOf(from.state, action, next.pose);
      if (!cost) continue;
      const double h = task_.wavefront(next);
      if (!std::isfinite(h) || !generated.insert(keyOf(next)).second) continue;
      nodes.push_back({next, from.g + *cost, id});
      if (task_.isGoal(next)) return planTo(nodes, nodes.size() - 1, expansions);
      open.push({nodes.back().g + h, nodes.size() - 1});
    }
  }
  return Plan{0.0, expansions, false, {}};
}

AncestorSearch::Plan AncestorSearch::planTo(const std::vector<Node>& nodes, std::size_t end,
                                            std::size_t expansions) const {
  Plan plan{nodes[end].g, expansions, task_.isGoal(nodes[end].state), {}};
  for (std::size_t i = end;; i = nodes[i].parent) {
    plan.trajectory.points.push_back(task_.pointOf(nodes[i].state));
    if (i == 0) break;
  }
  std::reverse(plan.trajectory.points.begin(), plan.trajectory.points.end());
  return plan;
}

}  // namespace lattice_planner::bench
