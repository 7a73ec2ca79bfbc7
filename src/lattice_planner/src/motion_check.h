// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include "lattice_planner/escape_zone.h"
#include "lattice_planner/footprint_check.h"
#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/state_pool.h"
#include "search_task.h"

namespace lattice_planner {

/// Where an action leads, whether it is free, and what it costs.
class MotionCheck {
 public:
  explicit MotionCheck(const SearchTask& task);

  /// For the task's present request.
  void reset();
  [[nodiscard]] const EscapeZone& escape() const { return escape_; }
  /// True when the robot finds itself in a place that is forbidden.
  [[nodiscard]] bool startsInside() const { return starts_inside_; }
  /// True when there is no place and heading within the goal's tolerances where the robot fits.
  [[nodiscard]] bool goalOccupied();

  /// Place, speeds, step and base cost after an action from a state; `c`, `s`: cosine and sine of its
  /// heading. False: it leads off the map.
  [[nodiscard]] bool advance(const SearchState& from, const MotionPrimitive& action, double c, double s,
                             SearchState& next) const;
  /// Collision and exposure along one action: each sample stands for its share of the time step. Adds to
  /// `cost`; `escaping` ends at the first free sample. False: not allowed.
  [[nodiscard]] bool traverse(const SearchState& from, const MotionPrimitive& action, double c, double s,
                              float& cost, bool& escaping);
  /// True when no person comes to where a robot in this state stands, from then to the end of the horizon.
  [[nodiscard]] bool standsFreeOfPeople(const SearchState& state);

 private:
  [[nodiscard]] double cellsInsteadOfLength(const sarn::CellIndex& from, const sarn::CellIndex& to,
                                            const MotionPrimitive& action) const;
  /// Cost of one sample's time in a cell.
  [[nodiscard]] float exposure(std::size_t index, int layer) const {
    const float static_part = task_.cell_costs.static_cost[task_.costmap.static_costs[index]];
    if (layer < 0) return static_part;
    const float social_part =
        task_.cell_costs.social_cost[task_.costmap.layers[static_cast<std::size_t>(layer)][index]];
    return task_.params.combine_with_max ? std::max(static_part, social_part) : static_part + social_part;
  }

  /// One pose of a motion, for a robot that is not round: allowed when nothing is under it, or when it
  /// escapes and is no deeper in than at the pose before.
  [[nodiscard]] bool footprintAllowed(const sarn::Pose2D& from, const sarn::Pose2D& to, int layer,
                                      bool escaping, bool& touches);

  const SearchTask& task_;
  EscapeZone escape_;
  FootprintCheck footprint_;
  bool starts_inside_ = false;
};

}  // namespace lattice_planner
