// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner::bench {

/// A textbook A* (Hart, Nilsson and Raphael 1968) on the ancestor's lattice at the ancestor's cost, written
/// anew without anything of the planner but its actions: re-opening, goal test at expansion, one state a
/// cell, heading bin, speeds and time step. Its heuristic is the ancestor's wavefront, lowered until it
/// hardly ever overestimates: max(0, 0.9 w - 450). Slow; it says what the planner's plans cost too much.
class Textbook {
 public:
  /// `params` is the ancestor's preset.
  explicit Textbook(const PlannerParams& params) : params_(params), lattice_(params) {}
  /// Least cost; nothing when there is no plan within `max_expansions`.
  [[nodiscard]] std::optional<double> solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                                            std::size_t max_expansions = 5000000);

 private:
  struct Node {
    sarn::Pose2D pose;
    double g;
    int v;
    int omega;
    int step;
    bool closed;
  };
  void computeWavefront(const PlanRequest& request, const sarn::TimedCostmapView& costmap);
  [[nodiscard]] double heuristic(const Node& node, const sarn::TimedCostmapView& costmap) const;
  [[nodiscard]] std::optional<double> costOf(const Node& from, const MotionPrimitive& action,
                                             const sarn::Pose2D& end, const PlanRequest& request,
                                             const sarn::TimedCostmapView& costmap) const;
  [[nodiscard]] std::uint64_t keyOf(const Node& node, const PlanRequest& request,
                                    const sarn::TimedCostmapView& costmap) const;
  [[nodiscard]] bool isGoal(const Node& node, const sarn::Pose2D& goal) const;

  PlannerParams params_;
  MotionLattice lattice_;
  std::vector<double> wavefront_;  // by cell; infinity: not reached
};

}  // namespace lattice_planner::bench
