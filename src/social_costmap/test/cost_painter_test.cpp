// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/cost_painter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fixtures.h"
#include "sarn_common/cost_values.h"

namespace social_costmap {
namespace {

const sarn::GridGeometry kGrid{83, 61, 0.05, -1.0, -0.5};

template <class Expected>
void expectCosts(const std::vector<std::uint8_t>& cells, double cutoff, Expected&& expected) {
  for (int y = 0; y < kGrid.height; ++y) {
    for (int x = 0; x < kGrid.width; ++x) {
      const double cost = expected(kGrid.center({x, y}));
      const int painted = cells[kGrid.index({x, y})];
      if (cost < cutoff - 0.02) {
        ASSERT_EQ(0, painted) << x << ", " << y << " cost " << cost;
      }
      if (cost > cutoff + 0.02) {
        ASSERT_NEAR(std::floor(cost), painted, 1.0) << x << ", " << y;
      }
    }
  }
}

void expectNothingOutside(const CellRect& rect, const std::vector<std::uint8_t>& cells) {
  for (int y = 0; y < kGrid.height; ++y) {
    for (int x = 0; x < kGrid.width; ++x) {
      if (!rect.contains({x, y})) {
        ASSERT_EQ(0, cells[kGrid.index({x, y})]) << x << ", " << y;
      }
    }
  }
}

SweptGaussian randomGaussian(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  SweptGaussian g;
  g.start = {-2.0 + 6.0 * u(random), -1.5 + 4.0 * u(random)};
  g.heading = -3.2 + 6.4 * u(random);
  g.length = u(random) < 0.3 ? 0.0 : u(random);
  g.sigma_front = 0.05 + u(random);
  g.sigma_rear = 0.05 + u(random);
  g.sigma_side = 0.05 + u(random);
  g.amplitude = 252.0 * u(random);
  return g;
}

TEST(CostPainter, agreesWithTheExponentialToOneUnit) {
  std::mt19937 random(2);
  for (int round = 0; round < 500; ++round) {
    const SweptGaussian g = randomGaussian(random);
    const double cutoff = round % 2 == 0 ? 10.0 : 1.0;
    std::vector<std::uint8_t> cells(kGrid.size(), 0);
    const CellRect rect = paint(g, cutoff, kGrid, cells.data());
    ASSERT_NO_FATAL_FAILURE(
        expectCosts(cells, cutoff, [&](const Eigen::Vector2d& p) { return costAt(g, p); }));
    ASSERT_NO_FATAL_FAILURE(expectNothingOutside(rect, cells));
  }
}

TEST(CostPainter, coversTheAxesExactly) {
  for (const double heading : {0.0, sarn::kPi / 2, sarn::kPi, -sarn::kPi / 2}) {
    SweptGaussian g{{1.0, 1.0}, heading, 0.5, 0.5, 0.4, 0.3, 225.0};
    std::vector<std::uint8_t> cells(kGrid.size(), 0);
    paint(g, 10.0, kGrid, cells.data());
    ASSERT_NO_FATAL_FAILURE(expectCosts(cells, 10.0, [&](const Eigen::Vector2d& p) { return costAt(g, p); }));
  }
}

TEST(CostPainter, blocksTheDiscThatAPersonSweeps) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    const Eigen::Vector2d a(-1.5 + 5.0 * u(random), -1.0 + 4.0 * u(random));
    const Eigen::Vector2d b = a + Eigen::Vector2d(u(random) - 0.5, round % 5 == 0 ? 0.0 : u(random) - 0.5);
    const double radius = 0.03 + 0.6 * u(random);
    std::vector<std::uint8_t> cells(kGrid.size(), 0);
    const CellRect rect = paint(SweptDisc{a, b, radius}, kGrid, cells.data());
    ASSERT_NO_FATAL_FAILURE(expectNothingOutside(rect, cells));
    for (int y = 0; y < kGrid.height; ++y) {
      for (int x = 0; x < kGrid.width; ++x) {
        const double distance = distanceTo(Polygon{a, b}, kGrid.center({x, y}));
        const int cost = cells[kGrid.index({x, y})];
        if (distance < radius - 1e-5) {
          ASSERT_EQ(sarn::kLethalObstacle, cost);
        }
        if (distance > std::max(radius, 0.05) + 1e-5) {
          ASSERT_EQ(0, cost);
        }
      }
    }
    if (const auto cell = kGrid.cellAt(b.x(), b.y())) {
      ASSERT_EQ(sarn::kLethalObstacle, cells[kGrid.index(*cell)]);
    }
  }
}

TEST(CostPainter, fadesAroundAPolygon) {
  const Polygon triangle{{0.5, 0.5}, {1.5, 0.6}, {1.0, 1.4}};
  const double sigma = 0.3;
  for (const Polygon& polygon : {triangle, Polygon{{0.2, 0.3}, {2.0, 1.0}}, Polygon{{1.0, 1.0}}}) {
    std::vector<std::uint8_t> cells(kGrid.size(), 0);
    const CellRect rect = paint(polygon, 180.0, sigma, 10.0, kGrid, cells.data());
    ASSERT_NO_FATAL_FAILURE(expectCosts(cells, 10.0, [&](const Eigen::Vector2d& p) {
      const double d = distanceTo(polygon, p);
      return 180.0 * std::exp(-d * d / (2.0 * sigma * sigma));
    }));
    ASSERT_NO_FATAL_FAILURE(expectNothingOutside(rect, cells));
  }
}

TEST(CostPainter, keepsTheLargerCost) {
  std::vector<std::uint8_t> cells(kGrid.size(), 200);
  paint(SweptGaussian{{1.0, 1.0}, 0.0, 0.0, 0.5, 0.5, 0.5, 225.0}, 10.0, kGrid, cells.data());
  EXPECT_EQ(200, *std::min_element(cells.begin(), cells.end()));
  EXPECT_GT(*std::max_element(cells.begin(), cells.end()), 220);
}

TEST(CostPainter, paintsNothingWhenTheAmplitudeIsBelowTheCutoff) {
  std::vector<std::uint8_t> cells(kGrid.size(), 0);
  EXPECT_TRUE(
      paint(SweptGaussian{{1.0, 1.0}, 0.0, 0.0, 0.5, 0.5, 0.5, 9.0}, 10.0, kGrid, cells.data()).empty());
  EXPECT_EQ(0, testing::paintedCells(cells));
}

}  // namespace
}  // namespace social_costmap
