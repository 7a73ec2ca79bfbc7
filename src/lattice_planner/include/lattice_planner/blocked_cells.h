// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice_planner/footprint_masks.h"
#include "sarn_common/grid.h"

namespace lattice_planner {

/// The cells of one layer that no part of the robot may touch, one bit each, and what is outside the map: so
/// that a mask is compared row by row, and most places need no comparison at all.
class BlockedCells {
 public:
  /// `blocked` by cell cost; masks will reach `reach` cells from their origins.
  void reset(const sarn::GridGeometry& geometry, const std::uint8_t* costs,
             const std::array<bool, 256>& blocked, int reach);

  /// False: no blocked cell is within reach of the cell, along each axis.
  [[nodiscard]] bool near(const sarn::CellIndex& cell) const { return test(near_, cell.x, cell.y); }
  /// How many blocked cells a mask at a cell touches; counts no further than `enough`.
  [[nodiscard]] int touched(const sarn::CellIndex& cell, const FootprintMasks::Mask& mask, int enough) const;

 private:
  using Words = std::vector<std::uint64_t>;
  [[nodiscard]] bool test(const Words& words, int x, int y) const {
    const auto column = static_cast<std::size_t>(x + reach_);
    return (words[static_cast<std::size_t>(y + reach_) * words_ + column / 64] >> (column % 64) & 1U) != 0;
  }
  void pack(const sarn::GridGeometry& geometry, const std::uint8_t* costs,
            const std::array<bool, 256>& blocked);
  void spreadAlongRows();
  void spreadAcrossRows();

  int reach_ = 0;          // [cells] also the border of blocked cells around the map
  std::size_t words_ = 0;  // a row
  std::size_t rows_ = 0;   // with the border
  Words cells_;
  Words near_;
};

}  // namespace lattice_planner
