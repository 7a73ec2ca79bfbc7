// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sarn {

/// Index of a grid cell; never a pose. Column x grows along the frame's x, row y along its y.
struct CellIndex {
  int x = 0;
  int y = 0;
  friend bool operator==(const CellIndex& a, const CellIndex& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const CellIndex& a, const CellIndex& b) { return !(a == b); }
};

/// Where an axis-aligned grid lies in its frame.
struct GridGeometry {
  int width = 0;            // [cells] along x
  int height = 0;           // [cells] along y
  double resolution = 1.0;  // [m] edge of a cell, > 0
  double origin_x = 0.0;    // [m] lower left corner of cell (0, 0)
  double origin_y = 0.0;    // [m]

  [[nodiscard]] bool contains(const CellIndex& cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width && cell.y < height;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// Row-major index; the cell must lie inside.
  [[nodiscard]] std::size_t index(const CellIndex& cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
  /// Cell that holds the point, which may lie outside the grid; the point must be finite and within int
  /// range.
  [[nodiscard]] CellIndex cellAtUnbounded(double x, double y) const {
    return {static_cast<int>(std::floor((x - origin_x) / resolution)),
            static_cast<int>(std::floor((y - origin_y) / resolution))};
  }
  /// Cell that holds the point; nothing when it is outside the grid or not finite.
  [[nodiscard]] std::optional<CellIndex> cellAt(double x, double y) const {
    const double column = (x - origin_x) / resolution;
    const double row = (y - origin_y) / resolution;
    if (!(column >= 0.0 && row >= 0.0 && column < width && row < height)) return std::nullopt;
    return CellIndex{static_cast<int>(column), static_cast<int>(row)};
  }
  /// Centre of a cell [m].
  [[nodiscard]] Eigen::Vector2d center(const CellIndex& cell) const {
    return {origin_x + (cell.x + 0.5) * resolution, origin_y + (cell.y + 0.5) * resolution};
  }
  friend bool operator==(const GridGeometry& a, const GridGeometry& b) {
    return a.width == b.width && a.height == b.height && a.resolution == b.resolution &&
           a.origin_x == b.origin_x && a.origin_y == b.origin_y;
  }
  friend bool operator!=(const GridGeometry& a, const GridGeometry& b) { return !(a == b); }
};

/// Values on a grid, row-major.
template <class T>
struct Grid {
  GridGeometry geometry;
  std::vector<T> cells;

  Grid() = default;
  Grid(const GridGeometry& g, const T& value) : geometry(g), cells(g.size(), value) {}
  [[nodiscard]] T& at(const CellIndex& cell) { return cells[geometry.index(cell)]; }
  [[nodiscard]] const T& at(const CellIndex& cell) const { return cells[geometry.index(cell)]; }
};

/// Calls visit(cell) for each cell that the segment from a to b [m] crosses, in order (Amanatides and Woo
/// 1987), inside the grid or not; stops when visit returns false.
template <class Visit>
void traverseCells(const GridGeometry& grid, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                   Visit&& visit) {
  CellIndex cell = grid.cellAtUnbounded(a.x(), a.y());
  const CellIndex last = grid.cellAtUnbounded(b.x(), b.y());
  const Eigen::Vector2d d = b - a;
  const int step_x = d.x() > 0.0 ? 1 : -1;
  const int step_y = d.y() > 0.0 ? 1 : -1;
  const double edge_x = grid.origin_x + (cell.x + (step_x > 0 ? 1 : 0)) * grid.resolution;
  const double edge_y = grid.origin_y + (cell.y + (step_y > 0 ? 1 : 0)) * grid.resolution;
  const double infinite = HUGE_VAL;
  double t_x = d.x() != 0.0 ? (edge_x - a.x()) / d.x() : infinite;
  double t_y = d.y() != 0.0 ? (edge_y - a.y()) / d.y() : infinite;
  const double delta_x = d.x() != 0.0 ? grid.resolution / std::abs(d.x()) : infinite;
  const double delta_y = d.y() != 0.0 ? grid.resolution / std::abs(d.y()) : infinite;
  int remaining = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  while (visit(cell) && remaining-- > 0) {
    if (t_x < t_y) {
      cell.x += step_x;
      t_x += delta_x;
    } else {
      cell.y += step_y;
      t_y += delta_y;
    }
  }
}

}  // namespace sarn
