// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "lattice_planner/plan_types.h"
#include "lattice_planner/state_pool.h"
#include "motion_check.h"
#include "search_task.h"

namespace lattice_planner {

/// The paper's fallback for a search that ends without a plan: the goal at any heading and speed, else the
/// best expanded state; each brought to a stop that is free, where nobody comes if there is such a place.
class PartialPlan {
 public:
  PartialPlan(const SearchTask& task, MotionCheck& motions, StatePool& pool)
      : task_(task), motions_(motions), pool_(pool) {}

  void reset();
  /// To be called with each expanded state.
  void note(StateId id);

  struct Ending {
    StateId state;  // standing
    PlanStatus status;
    bool timed_out;
  };
  /// The best that can be made of what was noted.
  [[nodiscard]] Ending best(bool timed_out);

 private:
  void forgetProgress();
  [[nodiscard]] std::vector<StateId> candidates() const;
  [[nodiscard]] bool staticallyConnected() const;
  [[nodiscard]] std::optional<StateId> safeStop(StateId from, bool check_collisions);
  [[nodiscard]] std::vector<MotionPrimitive> brakingActions(StateId from) const;
  [[nodiscard]] bool brakes(StateId from, const MotionPrimitive& action) const;
  [[nodiscard]] bool stands(StateId id) const;

  const SearchTask& task_;
  MotionCheck& motions_;
  StatePool& pool_;
  StateId any_pose_ = kNoState;    // cheapest at the goal's place
  StateId standing_ = kNoState;    // closest to the goal of those that stand
  std::vector<StateId> progress_;  // expanded states, each closer to the goal than the one before
  float closest_ = 0.0F;
};

}  // namespace lattice_planner
