// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "sarn_common/grid.h"

namespace lattice_planner {

/// The static layer as the distance field sees it: for each cell the smallest cost of its 3 x 3
/// neighbourhood, obstacles aside. Made anew only where the layer has changed since the last call.
class TraversalMap {
 public:
  static constexpr std::uint8_t kBlocked = 255;
  using Levels = std::array<std::uint8_t, 256>;

  /// `costs` are row-major; `levels` maps a cost to kBlocked or to what it counts as; blocked cells for which
  /// `exempt` (may be empty) is true count as their cost. False: all is new (another geometry, other levels,
  /// exemptions now or last time); true: only changed() is.
  bool update(const sarn::GridGeometry& geometry, const std::uint8_t* costs, const Levels& levels,
              const std::function<bool(const sarn::CellIndex&)>& exempt);

  /// Row-major, kBlocked where all nine cells are.
  [[nodiscard]] const std::vector<std::uint8_t>& thinned() const { return thinned_; }
  /// Indices of the cells whose thinned cost the last update changed, when it returned true.
  [[nodiscard]] const std::vector<std::uint32_t>& changed() const { return changed_; }

 private:
  void levelRow(int row, const std::function<bool(const sarn::CellIndex&)>& exempt);
  /// Smallest levels of 3 x 3 along a row, into row_.
  void thinRow(int row);
  void replaceRow(int row);
  [[nodiscard]] std::size_t begin(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(geometry_.width);
  }

  sarn::GridGeometry geometry_;
  Levels level_of_{};
  bool exempted_ = false;
  std::vector<std::uint8_t> costs_;  // the layer as it was
  std::vector<std::uint8_t> levels_;
  std::vector<std::uint8_t> thinned_;
  std::vector<std::uint8_t> row_;
  std::vector<std::uint8_t> column_minimum_;
  std::vector<std::uint32_t> changed_;
};

}  // namespace lattice_planner
