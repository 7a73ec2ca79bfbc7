// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/assignment.h"

#include <cmath>
#include <limits>

namespace sarn_perception {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A column of its own for each row stands for "nobody", at the price of the limit.
Eigen::MatrixXd withNobody(const Eigen::MatrixXd& cost, double limit) {
  Eigen::MatrixXd square = Eigen::MatrixXd::Constant(cost.rows(), cost.cols() + cost.rows(), limit);
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      if (cost(i, j) < limit) square(i, j) = cost(i, j);
    }
  }
  return square;
}

/// Dual variables and the matching so far; index 0 is the artificial row and column.
class Matching {
 public:
  explicit Matching(const Eigen::MatrixXd& cost)
      : cost_(cost),
        rows_(static_cast<std::size_t>(cost.rows())),
        columns_(static_cast<std::size_t>(cost.cols())),
        row_potential_(rows_ + 1, 0.0),
        column_potential_(columns_ + 1, 0.0),
        row_of_(columns_ + 1, 0),
        previous_(columns_ + 1, 0) {}

  /// Brings one more row in, along the cheapest augmenting path.
  void add(std::size_t row) {
    row_of_[0] = row;
    std::vector<double> slack(columns_ + 1, kInfinity);
    std::vector<bool> done(columns_ + 1, false);
    std::size_t column = 0;
    do {
      column = grow(column, slack, done);
    } while (row_of_[column] != 0);
    while (column != 0) {
      row_of_[column] = row_of_[previous_[column]];
      column = previous_[column];
    }
  }

  [[nodiscard]] std::size_t rowOf(std::size_t column) const { return row_of_[column]; }

 private:
  /// One step of Dijkstra's search over reduced costs: the next column of the tree.
  std::size_t grow(std::size_t column, std::vector<double>& slack, std::vector<bool>& done) {
    done[column] = true;
    const std::size_t row = row_of_[column];
    double least = kInfinity;
    std::size_t next = 0;
    for (std::size_t j = 1; j <= columns_; ++j) {
      if (done[j]) continue;
      const double reduced = cost_(static_cast<Eigen::Index>(row - 1), static_cast<Eigen::Index>(j - 1)) -
                             row_potential_[row] - column_potential_[j];
      if (reduced < slack[j]) {
        slack[j] = reduced;
        previous_[j] = column;
      }
      if (slack[j] < least) {
        least = slack[j];
        next = j;
      }
    }
    for (std::size_t j = 0; j <= columns_; ++j) {
      if (done[j]) {
        row_potential_[row_of_[j]] += least;
        column_potential_[j] -= least;
      } else {
        slack[j] -= least;
      }
    }
    return next;
  }

  const Eigen::MatrixXd& cost_;
  std::size_t rows_;
  std::size_t columns_;
  std::vector<double> row_potential_, column_potential_;
  std::vector<std::size_t> row_of_;    // a column: its row, 0: free
  std::vector<std::size_t> previous_;  // a column: the one before it on the path
};

}  // namespace

std::vector<int> assign(const Eigen::MatrixXd& cost, double limit) {
  std::vector<int> columns(static_cast<std::size_t>(cost.rows()), -1);
  if (cost.rows() == 0 || cost.cols() == 0) return columns;
  const Eigen::MatrixXd padded = withNobody(cost, limit);
  Matching matching(padded);
  for (std::size_t row = 1; row <= columns.size(); ++row) matching.add(row);
  for (Eigen::Index j = 0; j < cost.cols(); ++j) {
    const std::size_t row = matching.rowOf(static_cast<std::size_t>(j) + 1);
    if (row != 0 && cost(static_cast<Eigen::Index>(row - 1), j) < limit)
      columns[row - 1] = static_cast<int>(j);
  }
  return columns;
}

}  // namespace sarn_perception
