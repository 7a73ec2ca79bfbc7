// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/planner_params.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// Which of the people's layers holds at which sample of which action, and from when on nothing changes.
class TimeAxis {
 public:
  /// `start` [s] is when the first action begins. Adds to the costmap's layers one that holds after the
  /// prediction's end, where the parameters want it; the axis owns it.
  void reset(const PlannerParams& params, const MotionLattice& lattice, double start,
             sarn::TimedCostmapView& costmap);

  [[nodiscard]] int lastLayer() const { return last_layer_; }  // -1: nobody is predicted
  /// [time steps] From here on nothing changes with time.
  [[nodiscard]] std::uint32_t mergeStep() const { return merge_step_; }
  /// Layer of a sample of an action; -1: of the action's start.
  [[nodiscard]] int layerOf(std::uint32_t step, int sample) const {
    if (step >= merge_step_) return last_layer_;
    return layer_of_sample_[step * (samples_ + 1) + static_cast<std::size_t>(sample + 1)];
  }

 private:
  void appendLayerAfterHorizon(sarn::TimedCostmapView& costmap);
  [[nodiscard]] int firstOfTheLast(const sarn::TimedCostmapView& costmap) const;

  std::vector<std::uint8_t> after_horizon_;  // costs of the people who stand
  std::vector<int> layer_of_sample_;         // [step][start and samples], up to merge_step_
  std::size_t samples_ = 1;                  // an action
  std::uint32_t merge_step_ = 0;
  int last_layer_ = -1;
};

}  // namespace lattice_planner
