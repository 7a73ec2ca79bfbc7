// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/inflation_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fixtures.h"
#include "social_costmap/layered_costmap.h"
#include "social_costmap/static_layer.h"

namespace social_costmap {
namespace {

CostGrid inflated(const sarn::OccupancyMap& map, const InflationLayerParams& params) {
  LayeredCostmap costmap;
  StaticLayer& walls = costmap.addLayer(std::make_unique<StaticLayer>(StaticLayerParams{}));
  costmap.addLayer(std::make_unique<InflationLayer>(params));
  costmap.resize(map.geometry);
  walls.setMap(map);
  costmap.update({});
  return costmap.master();
}

double nearestWall(const sarn::OccupancyMap& map, const sarn::CellIndex& cell) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = 0; y < map.geometry.height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      if (map.at({x, y}) == sarn::kMapOccupied)
        nearest = std::min(nearest, std::hypot(x - cell.x, y - cell.y));
    }
  }
  return nearest * map.geometry.resolution;
}

TEST(InflationCost, followsTheFormulaOfCostmap2d) {
  InflationLayerParams params;  // inflation 0.5, scaling 5
  params.inscribed_radius = 0.18;
  EXPECT_EQ(254, inflationCost(params, 0.0));
  EXPECT_EQ(253, inflationCost(params, 0.05));
  EXPECT_EQ(253, inflationCost(params, 0.18));
  EXPECT_EQ(static_cast<int>(252.0 * std::exp(-5.0 * (0.3 - 0.18))), inflationCost(params, 0.3));
  EXPECT_EQ(static_cast<int>(252.0 * std::exp(-5.0 * (0.5 - 0.18))), inflationCost(params, 0.5));
  EXPECT_EQ(0, inflationCost(params, 0.5001));
}

TEST(InflationLayer, knowsExactDistancesOnRandomMaps) {
  std::mt19937 random(4);
  for (int round = 0; round < 10; ++round) {
    sarn::OccupancyMap map = testing::emptyMap(37, 29, 0.07);
    for (auto& cell : map.cells) cell = random() % 60 == 0 ? sarn::kMapOccupied : sarn::kMapFree;
    const InflationLayerParams params;
    const CostGrid costs = inflated(map, params);
    for (int y = 0; y < map.geometry.height; ++y) {
      for (int x = 0; x < map.geometry.width; ++x) {
        ASSERT_EQ(inflationCost(params, nearestWall(map, {x, y})), costs.at({x, y})) << x << ", " << y;
      }
    }
  }
}

TEST(InflationLayer, leavesUnknownCellsAloneUnlessTold) {
  const sarn::OccupancyMap map = testing::drawMap({"#..????"}, 0.1);
  InflationLayerParams params;
  const CostGrid kept = inflated(map, params);
  EXPECT_EQ(sarn::kNoInformation, kept.at({3, 0}));
  EXPECT_EQ(sarn::kNoInformation, kept.at({6, 0}));
  params.inflate_unknown = true;
  const CostGrid spread = inflated(map, params);
  EXPECT_EQ(inflationCost(params, 0.3), spread.at({3, 0}));
  EXPECT_EQ(sarn::kNoInformation, spread.at({6, 0})) << "beyond the inflation radius";
}

TEST(InflationLayer, blocksUnknownCellsWithinTheInscribedRadius) {
  InflationLayerParams params;
  params.inscribed_radius = 0.18;
  const CostGrid costs = inflated(testing::drawMap({"#?????"}, 0.1), params);
  EXPECT_EQ(sarn::kInscribedObstacle, costs.at({1, 0}));
  EXPECT_EQ(sarn::kNoInformation, costs.at({2, 0}));
}

TEST(InflationLayerParams, refusesAnInscribedRadiusBeyondTheInflation) {
  InflationLayerParams params;
  params.inscribed_radius = 0.6;
  EXPECT_EQ(1U, sarn::problems(params).size());
}

}  // namespace
}  // namespace social_costmap
