// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/live_planner.h"

#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

namespace sarn_navigation {

LivePlanner::LivePlanner(const lattice_planner::PlannerParams& params)
    : wanted_(params), planner_(std::make_unique<lattice_planner::LatticePlanner>(params)) {}

void LivePlanner::setParams(const lattice_planner::PlannerParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("planner: " + text);
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = params;
  changed_ = true;
}

lattice_planner::PlannerParams LivePlanner::params() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_;
}

/// Takes a planner that is ready and has the next one built when the parameters have changed since.
void LivePlanner::adopt(bool wait) {
  while (true) {
    if (building_.valid()) {
      const bool ready = wait || building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
      if (!ready) return;
      planner_ = building_.get();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!changed_) return;
    changed_ = false;
    building_ = std::async(std::launch::async, [params = wanted_] {
      return std::make_unique<lattice_planner::LatticePlanner>(params);
    });
  }
}

lattice_planner::PlanResult LivePlanner::plan(const lattice_planner::PlanRequest& request,
                                              const sarn::TimedCostmapView& costs) {
  const std::lock_guard<std::mutex> lock(planner_mutex_);
  adopt(false);
  return planner_->plan(request, costs);
}

void LivePlanner::waitUntilReady() {
  const std::lock_guard<std::mutex> lock(planner_mutex_);
  adopt(true);
}

}  // namespace sarn_navigation
