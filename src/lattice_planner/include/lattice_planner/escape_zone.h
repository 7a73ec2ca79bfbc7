// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// The escape rule: a robot that finds itself in a forbidden area may leave it, but while it is inside, a
/// motion must never take it deeper into the area, at that time, than standing still would. Depth is the
/// 8-connected number of cells to the nearest cell that is not forbidden. Lethal static cells stay forbidden,
/// and outside the window around the start nothing is exempt.
class EscapeZone {
 public:
  /// Looks whether the start is in a forbidden area in the static layer or in the time layer of `time` [s].
  void reset(const sarn::TimedCostmapView& costmap, const std::array<bool, 256>& forbidden_static,
             const std::array<bool, 256>& forbidden_social, const sarn::CellIndex& start, double time,
             double radius);

  [[nodiscard]] bool active() const { return active_; }
  /// Within the window around the start where the rule holds.
  [[nodiscard]] bool inWindow(const sarn::CellIndex& cell) const;
  /// Static cells of the window count as passable for the distance field.
  [[nodiscard]] bool exemptsStatic(const sarn::CellIndex& cell) const;
  /// May the robot go from cell `from` to the forbidden cell `to`? `layer` is the time layer then, -1 for
  /// none.
  [[nodiscard]] bool allows(const sarn::CellIndex& from, const sarn::CellIndex& to, int layer);

 private:
  [[nodiscard]] bool forbidden(const sarn::CellIndex& cell, int layer) const;
  [[nodiscard]] const std::vector<int>& depths(int layer);
  [[nodiscard]] std::size_t local(const sarn::CellIndex& cell) const;

  const sarn::TimedCostmapView* costmap_ = nullptr;
  const std::array<bool, 256>* forbidden_static_ = nullptr;
  const std::array<bool, 256>* forbidden_social_ = nullptr;
  sarn::CellIndex center_;
  int half_ = 0;  // [cells]
  bool active_ = false;
  bool static_active_ = false;
  std::vector<std::vector<int>> depth_;  // [layer + 1], empty until asked
};

}  // namespace lattice_planner
