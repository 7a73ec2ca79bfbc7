// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lattice_planner {

/// Which cells a polygon touches, precomputed for headings and for places of its origin within a cell.
/// Between those it is rounded so that no touched cell is ever left out: a quarter of a cell more on each
/// side (more only on grids much finer than the robot). Each row of cells is covered from the polygon's first
/// to its last: an outline that is hollow along x is filled.
class FootprintMasks {
 public:
  FootprintMasks() = default;
  /// `corners` [m] around the origin, at least three; `resolution` [m].
  FootprintMasks(const std::vector<Eigen::Vector2d>& corners, double resolution);

  /// Columns of one row, both ends included, relative to the origin's cell.
  struct Row {
    std::int16_t first;
    std::int16_t last;
  };
  struct Mask {
    const Row* rows;
    int first_row;  // relative to the origin's cell
    int count;
  };
  /// `fraction_x`, `fraction_y` [0, 1): where in its cell the origin lies; `theta` [rad].
  [[nodiscard]] Mask at(double fraction_x, double fraction_y, double theta) const;
  /// [cells] No mask goes farther from the origin's cell along either axis.
  [[nodiscard]] int reach() const { return reach_; }

 private:
  static constexpr int kPlaces = 4;  // along each axis of a cell
  void addMask(const std::vector<Eigen::Vector2d>& polygon);

  struct Entry {
    std::size_t begin;
    int first_row;
    int count;
  };
  int headings_ = 0;
  double margin_ = 0.0;  // [cells] of rounding: half a place, and what half a heading moves a corner
  int reach_ = 0;
  std::vector<Row> rows_;
  std::vector<Entry> masks_;  // [heading][place along y][place along x]
};

}  // namespace lattice_planner
