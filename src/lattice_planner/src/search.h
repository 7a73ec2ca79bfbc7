// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cost_to_go.h"
#include "lattice_planner/open_list.h"
#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "lattice_planner/state_pool.h"
#include "merge_key.h"
#include "motion_check.h"
#include "open_columns.h"
#include "partial_plan.h"
#include "sarn_common/timed_costmap_view.h"
#include "search_effort.h"
#include "search_task.h"

namespace lattice_planner {

/// One planner's search and its memory: anytime weighted A* (Hansen and Zhou 2007) whose weight falls to 1
/// with each better plan, re-opening included. Costs so far are exact; the frontier's smallest f bounds what
/// is lost.
class Search {
 public:
  explicit Search(const PlannerParams& params);
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap);
  [[nodiscard]] std::size_t memory() const { return pool_.memory(); }  // [bytes] of its states

 private:
  enum class Outcome { kProved, kExhausted, kGoodEnough, kOutOfTime };

  void prepare(const PlanRequest& request, const sarn::TimedCostmapView& costmap,
               SearchEffort::Clock::time_point deadline);
  [[nodiscard]] StateId addStart();

  [[nodiscard]] Outcome run();
  void expand(StateId id);
  struct Successor {
    const MotionPrimitive* action = nullptr;
    SearchState state;  // costs of cells not yet included
    std::uint64_t key = 0;
  };
  void tryAction(const SearchState& from, const Successor& successor, double c, double s);
  [[nodiscard]] float keyOf(const SearchState& state) const;
  void open(StateId id);
  void acceptGoal(StateId id);
  void reorderOpen();
  void sortIntoColumns();
  [[nodiscard]] bool anyOpen() const { return in_columns_ ? !columns_.empty() : !open_.empty(); }
  [[nodiscard]] bool proved();
  [[nodiscard]] bool goodEnough();

  void finish(Outcome outcome, PlanResult& result);
  [[nodiscard]] sarn::TimedTrajectory trajectoryTo(StateId id) const;

  SearchTask task_;
  CostToGo cost_to_go_;
  MotionCheck motions_;
  MergeKey merge_key_;
  SearchEffort effort_;
  StatePool pool_;
  OpenList open_;
  OpenColumns columns_;  // takes the place of open_ once in_columns_
  bool in_columns_ = false;
  FrontierBound frontier_;
  PartialPlan partial_plan_;
  std::vector<Successor> successors_;  // of the state being expanded
  StateId best_goal_ = kNoState;
  double best_cost_ = 0.0;
  std::optional<SearchEffort::Clock::time_point> first_plan_;  // when a plan to the goal was first in hand
};

}  // namespace lattice_planner
