// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/distance_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sarn {
namespace {

TEST(DistanceTransform, equalsBruteForceOnRandomGrids) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    Grid<std::uint8_t> occupied({13, 9, 0.25, 0.0, 0.0}, 0);
    std::bernoulli_distribution wall(round == 0 ? 0.01 : 0.1);
    for (auto& cell : occupied.cells) cell = wall(random) ? 1 : 0;
    occupied.at({4, 7}) = 1;
    const Grid<float> distance = distanceTransform(occupied);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 13; ++x) {
        double nearest = HUGE_VAL;
        for (int v = 0; v < 9; ++v) {
          for (int u = 0; u < 13; ++u) {
            if (occupied.at({u, v}) != 0) nearest = std::min(nearest, 0.25 * std::hypot(u - x, v - y));
          }
        }
        EXPECT_NEAR(distance.at({x, y}), nearest, 1e-5);
      }
    }
  }
}

TEST(DistanceTransform, isInfiniteWithoutObstacles) {
  const Grid<float> distance = distanceTransform(Grid<std::uint8_t>({4, 3, 1.0, 0.0, 0.0}, 0));
  for (const float d : distance.cells) EXPECT_TRUE(std::isinf(d));
}

}  // namespace
}  // namespace sarn
