// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <memory>
#include <mutex>
#include <optional>

#include "lattice_planner/lattice_planner.h"

namespace sarn_navigation {

/// A lattice planner whose parameters may change while it is used. A planner takes some tenths of a second to
/// build its tables: the new one is built in a thread of its own, and the old one plans until it is ready.
class LivePlanner {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit LivePlanner(const lattice_planner::PlannerParams& params);

  /// Any thread. The plans after the next few tenths of a second follow these. Throws std::invalid_argument.
  void setParams(const lattice_planner::PlannerParams& params);
  /// Any thread: what setParams() was given last.
  [[nodiscard]] lattice_planner::PlannerParams params() const;
  /// One thread at a time.
  [[nodiscard]] lattice_planner::PlanResult plan(const lattice_planner::PlanRequest& request,
                                                 const sarn::TimedCostmapView& costs);
  /// Blocks until the next plan will follow the parameters set last.
  void waitUntilReady();

 private:
  using Planner = std::unique_ptr<lattice_planner::LatticePlanner>;
  void adopt(bool wait);

  mutable std::mutex mutex_;  // wanted_, changed_
  lattice_planner::PlannerParams wanted_;
  bool changed_ = false;      // wanted_ is not being built yet
  std::mutex planner_mutex_;  // the rest
  Planner planner_;
  std::future<Planner> building_;
};

}  // namespace sarn_navigation
