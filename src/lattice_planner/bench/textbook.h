// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ancestor_task.h"

namespace lattice_planner::bench {

/// A textbook A* (Hart, Nilsson and Raphael 1968) on the ancestor's lattice at the ancestor's cost:
/// re-opening, goal test at expansion, one state a cell, heading bin, speeds and time step. Its heuristic is
/// the ancestor's wavefront, lowered until it hardly ever overestimates: max(0, 0.9 w - 450). Slow; it says
/// what the planner's plans cost too much.
class Textbook {
 public:
  /// `params` is the ancestor's preset.
  explicit Textbook(const PlannerParams& params) : task_(params) {}
  /// Least cost; nothing when there is no plan within `max_expansions`.
  [[nodiscard]] std::optional<double> solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                                            std::size_t max_expansions = 5000000);

 private:
  struct Node {
    AncestorTask::State state;
    double g = 0.0;
    bool closed = false;
  };
  [[nodiscard]] double heuristic(const AncestorTask::State& state) const;
  [[nodiscard]] std::uint64_t keyOf(const AncestorTask::State& state) const;

  AncestorTask task_;
};

}  // namespace lattice_planner::bench
