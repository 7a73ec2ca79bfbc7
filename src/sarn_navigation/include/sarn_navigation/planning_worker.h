// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "lattice_planner/lattice_planner.h"
#include "sarn_common/timed_costmap_view.h"

namespace sarn_navigation {

/// A search to be made: the request and the costs it is made on. The scene keeps its costs alive.
struct PlanningJob {
  lattice_planner::PlanRequest request;
  std::shared_ptr<const sarn::TimedCostmapView> scene;
};

/// The plan function, so that tests and baselines can put another planner in.
using PlanFunction = std::function<lattice_planner::PlanResult(const lattice_planner::PlanRequest&,
                                                               const sarn::TimedCostmapView&)>;

/// Cost of driving a trajectory from a time [s] on, on the given costs.
using CostFunction =
    std::function<double(const sarn::TimedTrajectory&, const sarn::TimedCostmapView&, double from)>;

/// Runs one search at a time in a thread of its own, so that control never waits for planning.
class PlanningWorker {
 public:
  explicit PlanningWorker(PlanFunction plan);
  ~PlanningWorker();
  PlanningWorker(const PlanningWorker&) = delete;
  PlanningWorker& operator=(const PlanningWorker&) = delete;

  /// Starts a search; the worker must be idle.
  void submit(PlanningJob job);
  [[nodiscard]] bool busy() const;
  /// The finished search's result, once.
  [[nodiscard]] std::optional<lattice_planner::PlanResult> poll();
  /// Blocks until no search is running (lockstep simulation).
  void wait() const;

 private:
  void run();

  PlanFunction plan_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<PlanningJob> job_;                     // waiting or running
  std::optional<lattice_planner::PlanResult> result_;  // finished, not yet polled
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace sarn_navigation
