// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice_planner/blocked_cells.h"
#include "lattice_planner/footprint.h"
#include "lattice_planner/footprint_masks.h"
#include "sarn_common/pose2d.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// Whether a robot that is not round is clear of a costmap, by costmap_2d's rules: no lethal cell, no unknown
/// one (unless allowed) and nothing outside the map under it, and its centre, which is for the caller to
/// check, on no cell that forbids it. Here all cells under the robot are looked at, not the outline alone.
///
/// People's layers show whom the *centre* of a robot of the inscribed radius must keep away from: there the
/// footprint's core (coreOf()) stands for the robot.
///
/// Of a robot's pose only one bit has to be read where nothing is within its reach. Layers are prepared when
/// they are first asked about: about 0.2 ms for 500 x 500 cells.
class FootprintCheck {
 public:
  FootprintCheck() = default;
  FootprintCheck(Footprint footprint, bool allow_unknown);

  /// False: the robot is round and there is nothing to check.
  [[nodiscard]] bool active() const { return !footprint_.round(); }
  [[nodiscard]] const Footprint& footprint() const { return footprint_; }

  /// The view must stay as it is until the next reset.
  void reset(const sarn::TimedCostmapView& costmap);

  /// A robot's place; the centre must be inside the map.
  [[nodiscard]] bool clearOfStatic(const sarn::Pose2D& pose) { return touchedStatic(pose, 1) == 0; }
  /// `layer` -1: there are no people.
  [[nodiscard]] bool clearOfPeople(const sarn::Pose2D& pose, int layer) {
    return touchedPeople(pose, layer, 1) == 0;
  }
  /// How deep it is in: forbidden cells under the robot, counted no further than `enough`.
  [[nodiscard]] int touchedStatic(const sarn::Pose2D& pose, int enough = 1 << 20);
  [[nodiscard]] int touchedPeople(const sarn::Pose2D& pose, int layer, int enough = 1 << 20);

 private:
  [[nodiscard]] int touched(const BlockedCells& cells, const FootprintMasks& masks, const sarn::Pose2D& pose,
                            int enough) const;

  Footprint footprint_;
  std::array<bool, 256> blocked_static_{};
  std::array<bool, 256> blocked_social_{};
  sarn::TimedCostmapView costmap_;
  double resolution_ = 0.0;  // [m] of the masks
  FootprintMasks body_;
  FootprintMasks core_;
  std::vector<BlockedCells> layers_;  // the static one, then people's
  std::vector<bool> prepared_;
};

}  // namespace lattice_planner
