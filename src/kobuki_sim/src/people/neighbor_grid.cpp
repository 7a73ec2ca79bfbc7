// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/neighbor_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kFewPoints = 24;  // up to here one cell that holds all is fastest
constexpr double kPointsPerCell = 2.0;
constexpr int kMaxCellsPerAxis = 256;

/// Keeps the nearest candidates, sorted.
class Nearest {
 public:
  Nearest(std::vector<Near>& found, double range, int max_count)
      : found_(found), limit_(range * range), max_count_(static_cast<std::size_t>(std::max(0, max_count))) {
    found_.clear();
    if (max_count_ == 0) limit_ = 0.0;
  }
  void offer(const Near& candidate) {
    if (candidate.squared_distance >= limit_) return;
    if (found_.size() < max_count_) {
      found_.push_back(candidate);
    } else {
      found_.back() = candidate;
    }
    for (std::size_t i = found_.size() - 1; i > 0; --i) {
      if (found_[i - 1].squared_distance <= found_[i].squared_distance) break;
      std::swap(found_[i - 1], found_[i]);
    }
    if (found_.size() == max_count_) limit_ = found_.back().squared_distance;
  }
  /// Squared distance [m^2] from which on nobody is taken.
  [[nodiscard]] double limit() const { return limit_; }

 private:
  std::vector<Near>& found_;
  double limit_;
  std::size_t max_count_;
};

}  // namespace

int NeighborGrid::column(double x) const {
  return static_cast<int>(std::clamp((x - origin_.x()) / cell_size_, 0.0, static_cast<double>(columns_ - 1)));
}

int NeighborGrid::row(double y) const {
  return static_cast<int>(std::clamp((y - origin_.y()) / cell_size_, 0.0, static_cast<double>(rows_ - 1)));
}

void NeighborGrid::fitCells(const std::vector<Vector2d>& positions, const std::vector<int>& indices) {
  columns_ = rows_ = 1;
  if (indices.size() <= kFewPoints) return;
  Vector2d low = positions[static_cast<std::size_t>(indices.front())];
  Vector2d high = low;
  for (const int i : indices) {
    low = low.cwiseMin(positions[static_cast<std::size_t>(i)]);
    high = high.cwiseMax(positions[static_cast<std::size_t>(i)]);
  }
  const Vector2d size = (high - low).cwiseMax(1e-3);
  const double cells = static_cast<double>(indices.size()) / kPointsPerCell;
  const double fitting = std::sqrt(size.x() * size.y() / cells);
  origin_ = low;
  cell_size_ = std::max(fitting, size.maxCoeff() / kMaxCellsPerAxis);
  columns_ = static_cast<int>(size.x() / cell_size_) + 1;
  rows_ = static_cast<int>(size.y() / cell_size_) + 1;
}

void NeighborGrid::build(const std::vector<Vector2d>& positions, const std::vector<int>& indices) {
  fitCells(positions, indices);
  const auto cell = [&](const Vector2d& p) {
    return static_cast<std::size_t>(row(p.y()) * columns_ + column(p.x()));
  };
  cell_begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const int i : indices) ++cell_begin_[cell(positions[static_cast<std::size_t>(i)])];
  int sum = 0;
  for (int& begin :
       cell_begin_) {  // counting sort: ends of the cells, which filling backwards turns into begins
    sum += begin;
    begin = sum;
  }
  entries_.resize(indices.size());
  for (auto i = indices.rbegin(); i != indices.rend(); ++i) {
    const Vector2d& p = positions[static_cast<std::size_t>(*i)];
    entries_[static_cast<std::size_t>(--cell_begin_[cell(p)])] = {p, *i};
  }
}

void NeighborGrid::nearest(const Vector2d& center, int self, double range, int max_count,
                           std::vector<Near>& found) const {
  Nearest nearest(found, range, max_count);
  const auto scan = [&](int row, int first_column, int last_column) {
    if (row < 0 || row >= rows_ || first_column > last_column) return;
    const auto begin =
        static_cast<std::size_t>(cell_begin_[static_cast<std::size_t>(row * columns_ + first_column)]);
    const auto end =
        static_cast<std::size_t>(cell_begin_[static_cast<std::size_t>(row * columns_ + last_column) + 1]);
    for (std::size_t k = begin; k < end; ++k) {
      if (entries_[k].index == self) continue;
      nearest.offer({(entries_[k].position - center).squaredNorm(), entries_[k].index});
    }
  };
  const int x = column(center.x());
  const int y = row(center.y());
  const int rings = std::max({x, columns_ - 1 - x, y, rows_ - 1 - y});
  // Whoever is in ring r is at least r - 1 cells away, and a centre outside the box only farther.
  for (int r = 0; r <= rings; ++r) {
    const double gap = (r - 1) * cell_size_;
    if (r > 1 && gap * gap >= nearest.limit()) break;
    const int left = std::max(x - r, 0);
    const int right = std::min(x + r, columns_ - 1);
    scan(y - r, left, right);
    if (r > 0) scan(y + r, left, right);
    for (int inner = y - r + 1; inner < y + r; ++inner) {
      if (x - r >= 0) scan(inner, x - r, x - r);
      if (x + r < columns_) scan(inner, x + r, x + r);
    }
  }
}

}  // namespace kobuki_sim
