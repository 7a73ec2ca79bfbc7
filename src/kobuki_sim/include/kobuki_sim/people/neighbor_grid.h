// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace kobuki_sim {

/// Somebody near, by index.
struct Near {
  double squared_distance = 0.0;  // [m^2] centre to centre
  int index = -1;
};

/// Finds the nearest points among many: a uniform grid over their bounding box, sorted by cell. Rebuilt from
/// a new snapshot without allocation once its memory has grown to the crowd's size.
class NeighborGrid {
 public:
  /// Takes positions[i] for each i in `indices`; both are copied.
  void build(const std::vector<Eigen::Vector2d>& positions, const std::vector<int>& indices);

  /// The nearest `max_count` points closer than `range` [m] to `center`, nearest first, without point `self`.
  void nearest(const Eigen::Vector2d& center, int self, double range, int max_count,
               std::vector<Near>& found) const;

 private:
  struct Entry {
    Eigen::Vector2d position;
    int index = 0;
  };

  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  void fitCells(const std::vector<Eigen::Vector2d>& positions, const std::vector<int>& indices);

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();  // [m] lower left corner
  double cell_size_ = 1.0;                            // [m]
  int columns_ = 1;
  int rows_ = 1;
  std::vector<int> cell_begin_;  // first entry of each cell; one more at the end
  std::vector<Entry> entries_;   // sorted by cell
};

}  // namespace kobuki_sim
