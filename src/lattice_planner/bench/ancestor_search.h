// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ancestor_task.h"
#include "sarn_common/timed_trajectory.h"

namespace lattice_planner::bench {

/// The search of the published implementation (Kollmitz et al. 2015), rebuilt from what is known of it, to
/// say what its plans cost on the same tasks: A* with its wavefront as heuristic, where the first state that
/// is generated in a cell, heading bin, speeds and time step wins and the first goal that is generated ends
/// it. Seventeen heading bins in the map frame, the first and the last of which are two halves of one.
class AncestorSearch {
 public:
  struct Plan {
    double cost = 0.0;  // without its discount of 10 for being at the goal
    std::size_t expansions = 0;
    bool reached = false;  // the original does not tell
    /// To the goal; cut short: to the top of the open list; empty: nothing is left to look at.
    sarn::TimedTrajectory trajectory;
  };

  /// `params` is the ancestor's preset.
  explicit AncestorSearch(const PlannerParams& params) : task_(params) {}
  /// Without a limit of time; cut short after `max_expansions`.
  [[nodiscard]] Plan solve(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
                           std::size_t max_expansions = 5000000);
  /// Of a heading [rad] in the map frame: 0 to 16.
  [[nodiscard]] long headingBin(double theta) const;
  /// The task last solved.
  [[nodiscard]] const AncestorTask& task() const { return task_; }

 private:
  struct Node {
    AncestorTask::State state;
    double g = 0.0;
    std::size_t parent = 0;
  };
  [[nodiscard]] Plan planTo(const std::vector<Node>& nodes, std::size_t end, std::size_t expansions) const;
  [[nodiscard]] std::uint64_t keyOf(const AncestorTask::State& state) const;

  AncestorTask task_;
};

}  // namespace lattice_planner::bench
