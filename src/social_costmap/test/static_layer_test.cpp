// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/static_layer.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "sarn_common/cost_values.h"
#include "social_costmap/layered_costmap.h"

namespace social_costmap {
namespace {

CostGrid costsOf(const sarn::OccupancyMap& map, const StaticLayerParams& params,
                 const sarn::GridGeometry& master) {
  LayeredCostmap costmap;
  StaticLayer& layer = costmap.addLayer(std::make_unique<StaticLayer>(params));
  costmap.resize(master);
  layer.setMap(map);
  costmap.update({});
  return costmap.master();
}

TEST(StaticLayer, mapsOccupancyToCosts) {
  sarn::OccupancyMap map = testing::drawMap({".....", "#?..."});
  map.at({2, 0}) = 64;
  map.at({3, 0}) = 65;
  const CostGrid costs = costsOf(map, {}, map.geometry);
  EXPECT_EQ(sarn::kLethalObstacle, costs.at({0, 0}));
  EXPECT_EQ(sarn::kNoInformation, costs.at({1, 0}));
  EXPECT_EQ(sarn::kFreeSpace, costs.at({2, 0}));
  EXPECT_EQ(sarn::kLethalObstacle, costs.at({3, 0}));
  EXPECT_EQ(sarn::kFreeSpace, costs.at({0, 1}));
}

TEST(StaticLayer, takesUnknownForFreeWhenTold) {
  StaticLayerParams params;
  params.track_unknown_space = false;
  const sarn::OccupancyMap map = testing::drawMap({"?#"});
  EXPECT_EQ(sarn::kFreeSpace, costsOf(map, params, map.geometry).at({0, 0}));
}

TEST(StaticLayer, samplesAMapOfAnotherGeometry) {
  const sarn::OccupancyMap map = testing::drawMap({"..", "#."}, 1.0);
  const CostGrid costs = costsOf(map, {}, {6, 4, 0.5, -0.5, 0.0});
  EXPECT_EQ(sarn::kNoInformation, costs.at({0, 0})) << "outside the map";
  EXPECT_EQ(sarn::kLethalObstacle, costs.at({1, 0}));
  EXPECT_EQ(sarn::kLethalObstacle, costs.at({2, 1}));
  EXPECT_EQ(sarn::kFreeSpace, costs.at({3, 0}));
  EXPECT_EQ(sarn::kFreeSpace, costs.at({1, 2}));
  EXPECT_EQ(sarn::kNoInformation, costs.at({5, 0}));
}

}  // namespace
}  // namespace social_costmap
