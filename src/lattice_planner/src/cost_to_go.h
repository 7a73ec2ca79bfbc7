// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "crowded_map.h"
#include "lattice_planner/alignment_table.h"
#include "lattice_planner/distance_field.h"
#include "lattice_planner/escape_zone.h"
#include "lattice_planner/goal_table.h"
#include "lattice_planner/space_time_field.h"
#include "lattice_planner/state_pool.h"
#include "search_task.h"

namespace lattice_planner {

/// What a state still costs: the admissible bound, which proves, and the guess, which chooses what to look at
/// first.
class CostToGo {
 public:
  /// Builds the tables of the lattice (some tenths of a second).
  explicit CostToGo(const SearchTask& task);

  /// For the task's present request; `keep_going` is asked now and then: false ends what is being computed.
  void reset(const EscapeZone& escape, std::function<bool()> keep_going);
  /// Before the first guess, once a search is worth it: looks at the people.
  void look();

  /// Lower bound from a place over the static layer alone; infinity: the goal cannot be reached.
  [[nodiscard]] float boundAt(double x, double y) {
    return field_.at(task_.costmap.geometry.cellAtUnbounded(x, y));
  }
  /// Fills in a state's h and estimate. The guess: the way at its likely cost, what people add to it, and
  /// turning into its direction; near the goal the table knows better.
  void judge(SearchState& state);

 private:
  [[nodiscard]] SpaceTimeField::Estimate guessAt(const SearchState& state);
  [[nodiscard]] DistanceFieldTask fieldTask() const;
  [[nodiscard]] float turning(const SearchState& state, const SpaceTimeField::Estimate& place) const;

  const SearchTask& task_;
  std::function<bool(const sarn::CellIndex&)> exempt_;
  GoalTable table_;
  AlignmentTable alignment_;
  DistanceField field_;
  SpaceTimeField people_field_;
  CrowdedMap crowded_map_;       // who stays where the time layers end
  DistanceField crowded_field_;  // among them
  bool crowded_ = false;
};

}  // namespace lattice_planner
