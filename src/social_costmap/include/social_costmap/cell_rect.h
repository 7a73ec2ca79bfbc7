// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "sarn_common/grid.h"

namespace social_costmap {

/// A rectangle of cells, half open: min_x <= x < max_x, min_y <= y < max_y. Empty by default.
struct CellRect {
  int min_x = 0;
  int min_y = 0;
  int max_x = 0;
  int max_y = 0;

  [[nodiscard]] bool empty() const { return min_x >= max_x || min_y >= max_y; }
  [[nodiscard]] int width() const { return empty() ? 0 : max_x - min_x; }
  [[nodiscard]] int height() const { return empty() ? 0 : max_y - min_y; }
  [[nodiscard]] bool contains(const sarn::CellIndex& c) const {
    return c.x >= min_x && c.x < max_x && c.y >= min_y && c.y < max_y;
  }
  /// Grows to hold another rectangle; empty ones add nothing.
  void unite(const CellRect& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    min_x = std::min(min_x, other.min_x);
    min_y = std::min(min_y, other.min_y);
    max_x = std::max(max_x, other.max_x);
    max_y = std::max(max_y, other.max_y);
  }
  void unite(const sarn::CellIndex& c) { unite(CellRect{c.x, c.y, c.x + 1, c.y + 1}); }
  /// Grown by `margin` cells on each side; an empty rectangle stays empty.
  [[nodiscard]] CellRect expanded(int margin) const {
    if (empty()) return {};
    return {min_x - margin, min_y - margin, max_x + margin, max_y + margin};
  }
  /// The part inside the grid.
  [[nodiscard]] CellRect clipped(const sarn::GridGeometry& grid) const {
    const CellRect inside{std::max(min_x, 0), std::max(min_y, 0), std::min(max_x, grid.width),
                          std::min(max_y, grid.height)};
    return inside.empty() ? CellRect{} : inside;
  }
  [[nodiscard]] static CellRect whole(const sarn::GridGeometry& grid) {
    return {0, 0, grid.width, grid.height};
  }
  friend bool operator==(const CellRect& a, const CellRect& b) {
    return a.min_x == b.min_x && a.min_y == b.min_y && a.max_x == b.max_x && a.max_y == b.max_y;
  }
};

}  // namespace social_costmap
