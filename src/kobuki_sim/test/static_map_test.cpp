// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/static_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "drawn_map.h"
#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

const StaticMap kRoom = drawnMap({"########",  //
                                  "#......#",  //
                                  "#..#...#",  //
                                  "#......#",  //
                                  "########"},
                                 0.5);

/// Nearest wall by looking at every cell.
double bruteForceDistance(const StaticMap& map, const Eigen::Vector2d& p) {
  double best = std::numeric_limits<double>::infinity();
  const auto& grid = map.geometry();
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!map.occupied(sarn::CellIndex{x, y})) continue;
      const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * grid.resolution);
      const Eigen::Vector2d outside = ((p - grid.center({x, y})).cwiseAbs() - half).cwiseMax(0.0);
      best = std::min(best, outside.norm());
    }
  }
  return best;
}

TEST(StaticMap, withoutMapAllIsOpen) {
  const StaticMap open;
  EXPECT_TRUE(open.empty());
  EXPECT_FALSE(open.occupied(Eigen::Vector2d(0, 0)));
  EXPECT_FALSE(open.nearestWall({0, 0}, 100.0));
  EXPECT_FALSE(open.rayCast({0, 0}, {1, 0}, 100.0));
  EXPECT_TRUE(open.discFree({0, 0}, 10.0));
  EXPECT_TRUE(open.segmentFree({0, 0}, {9, 9}));
  EXPECT_EQ(open.pushOut({1, 2}, 5.0), Eigen::Vector2d(1, 2));
  EXPECT_TRUE(std::isinf(open.clearanceLowerBound({0, 0})));
}

TEST(StaticMap, nearestWallEqualsBruteForceAndItsBoundIsBelow) {
  RandomStream random(1);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d p(random.uniform(-2.0, 6.0), random.uniform(-2.0, 5.0));
    const double expected = bruteForceDistance(kRoom, p);
    const auto wall = kRoom.nearestWall(p, 10.0);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->distance, expected, 1e-12);
    EXPECT_NEAR((wall->point - p).norm(), expected, 1e-12);
    EXPECT_LE(kRoom.clearanceLowerBound(p), expected + 1e-6);
    EXPECT_EQ(kRoom.nearestWall(p, 0.3).has_value(), expected <= 0.3);
    EXPECT_EQ(kRoom.discFree(p, 0.3), expected >= 0.3);
  }
}

TEST(StaticMap, rayCastEqualsMarchingInSmallSteps) {
  RandomStream random(2);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d origin(random.uniform(-1.0, 5.0), random.uniform(-1.0, 3.5));
    const double angle = random.uniform(-3.14, 3.14);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    std::optional<double> marched;
    for (double t = 0.0; t <= 3.0 && !marched; t += kStep) {
      if (kRoom.occupied(Eigen::Vector2d(origin + t * direction))) marched = t;
    }
    const auto hit = kRoom.rayCast(origin, direction, 3.0);
    if (!marched) {
      // A corner cut shorter than a step may be missed by marching only.
      if (hit) {
        EXPECT_TRUE(kRoom.nearestWall(hit->point, 1e-6));
      }
      continue;
    }
    ASSERT_TRUE(hit) << origin.transpose() << " at " << angle;
    EXPECT_LE(hit->distance, *marched + 1e-9);
    EXPECT_NEAR(bruteForceDistance(kRoom, hit->point), 0.0, 1e-9);
    if (hit->distance > 0.0) {
      EXPECT_LT(hit->normal.dot(direction), 0.0);
    }
  }
}

TEST(StaticMap, rayReportsDistancePointAndNormalOfAWall) {
  const auto hit = kRoom.rayCast({1.0, 0.75}, {1.0, 0.0}, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 2.5, 1e-12);
  EXPECT_NEAR(hit->point.x(), 3.5, 1e-12);
  EXPECT_EQ(hit->normal, Eigen::Vector2d(-1.0, 0.0));
  EXPECT_FALSE(kRoom.rayCast({1.0, 0.75}, {1.0, 0.0}, 2.4));
  EXPECT_EQ(kRoom.rayCast({0.1, 0.1}, {1.0, 0.0}, 1.0)->distance, 0.0);
}

TEST(StaticMap, segmentIsFreeUnlessAWallLiesBetween) {
  EXPECT_TRUE(kRoom.segmentFree({0.75, 0.75}, {3.2, 0.75}));
  EXPECT_FALSE(kRoom.segmentFree({0.75, 1.25}, {3.2, 1.25}));
  EXPECT_FALSE(kRoom.segmentFree({0.75, 0.75}, {0.75, 9.0}));
}

TEST(StaticMap, pushOutFreesADiscAndLeavesAFreeOneAlone) {
  RandomStream random(3);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(random.uniform(0.5, 3.5), random.uniform(0.5, 2.0));
    const Eigen::Vector2d free = kRoom.pushOut(p, 0.2);
    EXPECT_GE(bruteForceDistance(kRoom, free), 0.2);
    if (bruteForceDistance(kRoom, p) >= 0.2) {
      EXPECT_EQ(free, p);
    }
  }
}

TEST(StaticMap, unknownCellsAreNoWalls) {
  sarn::OccupancyMap map({2, 1, 1.0, 0.0, 0.0}, sarn::kMapUnknown);
  const StaticMap unknown(map);
  EXPECT_FALSE(unknown.occupied(Eigen::Vector2d(0.5, 0.5)));
  EXPECT_FALSE(unknown.nearestWall({0.5, 0.5}, 100.0));
}

}  // namespace
}  // namespace kobuki_sim
