// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sarn {
namespace {

const GridGeometry kGrid{20, 10, 0.5, -3.0, -2.0};

TEST(GridGeometry, mapsPointsToCellsAndBack) {
  EXPECT_EQ(*kGrid.cellAt(-3.0, -2.0), (CellIndex{0, 0}));
  EXPECT_EQ(*kGrid.cellAt(6.99, 2.99), (CellIndex{19, 9}));
  EXPECT_FALSE(kGrid.cellAt(7.0, 0.0));
  EXPECT_FALSE(kGrid.cellAt(-3.01, 0.0));
  EXPECT_FALSE(kGrid.cellAt(std::numeric_limits<double>::quiet_NaN(), 0.0));
  EXPECT_FALSE(kGrid.cellAt(0.0, std::numeric_limits<double>::infinity()));
  const Eigen::Vector2d center = kGrid.center({3, 4});
  EXPECT_EQ(*kGrid.cellAt(center.x(), center.y()), (CellIndex{3, 4}));
}

TEST(TraverseCells, visitsConnectedCellsFromFirstToLast) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-5.0, 9.0);
  std::uniform_real_distribution<double> y(-4.0, 5.0);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d a(x(random), y(random));
    const Eigen::Vector2d b(x(random), y(random));
    std::vector<CellIndex> cells;
    traverseCells(kGrid, a, b, [&](const CellIndex& cell) {
      cells.push_back(cell);
      return true;
    });
    EXPECT_EQ(cells.front(), kGrid.cellAtUnbounded(a.x(), a.y()));
    EXPECT_EQ(cells.back(), kGrid.cellAtUnbounded(b.x(), b.y()));
    for (std::size_t k = 1; k < cells.size(); ++k) {
      EXPECT_EQ(std::abs(cells[k].x - cells[k - 1].x) + std::abs(cells[k].y - cells[k - 1].y), 1);
    }
  }
}

TEST(TraverseCells, stopsWhenTheVisitorSaysSo) {
  int visits = 0;
  traverseCells(kGrid, {-2.9, -1.9}, {6.0, -1.9}, [&](const CellIndex&) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

}  // namespace
}  // namespace sarn
