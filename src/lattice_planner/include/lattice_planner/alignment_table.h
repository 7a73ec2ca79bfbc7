// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lattice_planner/motion_lattice.h"

namespace lattice_planner {

/// What it costs to get going in a wanted direction, far from everything: the least of (cost - progress *
/// costPerMetre) over all futures, from a heading relative to the direction and from speeds. Zero when
/// driving that way at full speed.
class AlignmentTable {
 public:
  AlignmentTable() = default;
  explicit AlignmentTable(const MotionLattice& lattice);
  /// `heading` [rad] relative to the wanted direction, any value; lattice speeds.
  [[nodiscard]] float at(double heading, int v, int omega) const;

 private:
  static constexpr int kHeadings = 120;
  int angular_speeds_ = 1;
  int speed_pairs_ = 1;
  std::vector<float> values_;  // [heading][speeds]
};

}  // namespace lattice_planner
