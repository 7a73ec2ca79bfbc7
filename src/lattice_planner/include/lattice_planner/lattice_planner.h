// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

class Search;

/// Time-dependent planner of a differential drive: anytime A* over (x, y, theta, v, omega, t) with the
/// actions
/// {-1, 0, 1} x {-1, 0, 1} of forward and angular acceleration (Kollmitz, Hsiao, Gaa and Burgard, "Time
/// dependent planning on a layered social cost map for human-aware robot navigation", ECMR 2015).
///
/// The answer is the cheapest trajectory of its lattice up to the merging of states, when time allows, and
/// otherwise the cheapest found with a bound on what is lost. Beyond the last time layer people stay where it
/// shows them.
///
/// A start inside a forbidden area (static cost 253, or a person's forbidden disc that came to the robot) is
/// left by the escape rule: until it is out, the robot may move only so that it is nowhere deeper in the area
/// than it would be by standing still. Only a lethal static cell is refused.
///
/// Not thread-safe: one planner a thread. No allocation per state once the pools have grown to the task.
class LatticePlanner {
 public:
  /// Builds the goal table (some tenths of a second). Throws std::invalid_argument that names every problem.
  explicit LatticePlanner(const PlannerParams& params);
  ~LatticePlanner();
  LatticePlanner(LatticePlanner&&) noexcept;
  LatticePlanner& operator=(LatticePlanner&&) noexcept;

  /// Never throws for bad input: see PlanStatus. Returns within request.time_limit (to a few milliseconds).
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap);

  [[nodiscard]] const PlannerParams& params() const { return params_; }
  /// [bytes] that the states of the searches so far have grown to.
  [[nodiscard]] std::size_t memory() const;

 private:
  PlannerParams params_;
  std::unique_ptr<Search> search_;
};

}  // namespace lattice_planner
