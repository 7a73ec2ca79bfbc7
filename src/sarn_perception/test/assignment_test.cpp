// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace sarn_perception {
namespace {

double costOf(const Eigen::MatrixXd& cost, double limit, const std::vector<int>& columns) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    sum += columns[i] < 0 ? limit : cost(static_cast<Eigen::Index>(i), columns[i]);
  }
  return sum;
}

/// Tries every way to give columns to rows from `row` on.
double leastCost(const Eigen::MatrixXd& cost, double limit, Eigen::Index row, std::vector<bool>& taken) {
  if (row == cost.rows()) return 0.0;
  double least = limit + leastCost(cost, limit, row + 1, taken);
  for (Eigen::Index j = 0; j < cost.cols(); ++j) {
    const auto column = static_cast<std::size_t>(j);
    if (taken[column] || !(cost(row, j) < limit)) continue;
    taken[column] = true;
    least = std::min(least, cost(row, j) + leastCost(cost, limit, row + 1, taken));
    taken[column] = false;
  }
  return least;
}

TEST(Assignment, prefersTheBestWholeToTheBestPair) {
  Eigen::MatrixXd cost(2, 2);
  cost << 1.0, 2.0,  //
      1.5, 9.0;
  EXPECT_EQ(assign(cost, 100.0), (std::vector<int>{1, 0})) << "1.5 + 2 is less than 1 + 9";
}

TEST(Assignment, givesNothingThatCostsTheLimit) {
  Eigen::MatrixXd cost(2, 2);
  cost << 5.0, std::numeric_limits<double>::infinity(),  //
      std::nan(""), 3.0;
  EXPECT_EQ(assign(cost, 5.0), (std::vector<int>{-1, 1}));
}

TEST(Assignment, handlesEmptySides) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3), 1.0).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0), 1.0), (std::vector<int>{-1, -1}));
}

TEST(Assignment, isOptimalOnRandomMatrices) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-3.0, 10.0);
  for (int trial = 0; trial < 200; ++trial) {
    const auto rows = static_cast<Eigen::Index>(1 + random() % 5);
    const auto columns = static_cast<Eigen::Index>(1 + random() % 5);
    Eigen::MatrixXd cost(rows, columns);
    for (Eigen::Index i = 0; i < cost.size(); ++i) cost(i) = value(random);
    const double limit = 6.0;
    const std::vector<int> result = assign(cost, limit);
    std::vector<bool> taken(static_cast<std::size_t>(columns), false);
    EXPECT_NEAR(costOf(cost, limit, result), leastCost(cost, limit, 0, taken), 1e-9);
    std::vector<int> used;
    std::copy_if(result.begin(), result.end(), std::back_inserter(used), [](int c) { return c >= 0; });
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end()) << "a column was given twice";
  }
}

}  // namespace
}  // namespace sarn_perception
