// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/timed_costmap.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "fixtures.h"
#include "sarn_common/cost_values.h"

namespace social_costmap {
namespace {

using testing::prediction;
using testing::walker;

Scan beamFrom(double x, double y, float range, double stamp) {
  return {{x, y, 0.0}, 0.0, 0.01, 0.1, 10.0, stamp, {range}};
}

TEST(TimedCostmap, joinsWallsAndPeopleInOneView) {
  TimedCostmap costmap{CostmapParams{}};
  sarn::OccupancyMap map = testing::emptyMap(100, 100);
  map.at({10, 10}) = sarn::kMapOccupied;
  costmap.setMap(map);
  costmap.setPrediction(prediction({walker("anna", {2.5, 2.5}, {0.5, 0.0})}));
  const auto snapshot = costmap.update({0.0, 0.0, 0.0}, 10.0);
  const sarn::TimedCostmapView view = snapshot->view();
  EXPECT_EQ(map.geometry, view.geometry);
  EXPECT_EQ(254, view.static_costs[map.geometry.index({10, 10})]);
  EXPECT_EQ(253, view.static_costs[map.geometry.index({12, 10})]);
  ASSERT_EQ(30U, view.layers.size());
  EXPECT_EQ(10.0, view.first_layer_time);
  EXPECT_EQ(0.5, view.layer_duration);
  const int layer = view.layerAt(12.1);  // she is at 3.55
  EXPECT_EQ(254, view.layers[static_cast<std::size_t>(layer)][map.geometry.index({71, 50})]);
  EXPECT_EQ(254, view.layers[0][map.geometry.index({50, 50})]);
}

TEST(TimedCostmap, publishesNothingBeforeItHasAMap) {
  TimedCostmap costmap{CostmapParams{}};
  EXPECT_FALSE(costmap.update({}, 1.0));
  EXPECT_FALSE(costmap.snapshot());
}

TEST(TimedCostmap, neverChangesASnapshot) {
  TimedCostmap costmap{CostmapParams{}};
  costmap.setMap(testing::emptyMap(80, 80));
  costmap.setPrediction(prediction({walker("anna", {2.0, 2.0}, {0.5, 0.0})}));
  const auto held = costmap.update({}, 10.0);
  const auto cells = held->layers[0].cells;
  for (int i = 1; i < 20; ++i) {
    costmap.setPrediction(prediction({walker("anna", {2.0, 2.0 + 0.1 * i}, {0.5, 0.0})}, 10.0 + 0.1 * i));
    if (i == 7) costmap.setMap(testing::emptyMap(50, 60));
    costmap.update({}, 10.0 + 0.1 * i);
  }
  EXPECT_EQ(cells, held->layers[0].cells);
  EXPECT_EQ(80, held->static_costs.geometry.width);
  EXPECT_EQ(50, costmap.snapshot()->static_costs.geometry.width);
}

TEST(TimedCostmap, pooledSnapshotsEqualFreshOnes) {
  TimedCostmap costmap{CostmapParams{}};
  costmap.setMap(testing::emptyMap(80, 80));
  for (int i = 0; i < 200; ++i) {
    const double now = 0.1 * i;
    const auto people = prediction({walker("anna", {0.02 * i, 2.0}, {0.5, 0.0})}, now);
    costmap.setPrediction(people);
    const auto scan = beamFrom(1.0, 3.0, 0.5F + 0.01F * static_cast<float>(i % 100), now);
    ASSERT_FALSE(costmap.addScan(scan));
    const auto snapshot = costmap.update({}, now);
    if (i % 25 != 0) continue;
    SocialLayers fresh{SocialParams{}};
    fresh.resize({80, 80, 0.05, 0.0, 0.0});
    fresh.update(people, now);
    for (std::size_t k = 0; k < fresh.timeLayers().size(); ++k) {
      ASSERT_EQ(fresh.timeLayers()[k].cells, snapshot->layers[k].cells) << i;
    }
    const sarn::CellIndex end =
        *snapshot->static_costs.geometry.cellAt(1.0 + static_cast<double>(scan.ranges[0]), 3.0);
    ASSERT_EQ(254, snapshot->static_costs.at(end)) << i;
  }
}

TEST(TimedCostmap, forgetsObstaclesOnRequestAndWhenTheClockJumpsBack) {
  TimedCostmap costmap{CostmapParams{}};
  costmap.setMap(testing::emptyMap(80, 80));
  const auto marked = [&](double now) { return costmap.update({}, now)->static_costs.at({40, 40}) == 254; };
  ASSERT_FALSE(costmap.addScan(beamFrom(1.0, 2.02, 1.02F, 50.0)));
  EXPECT_TRUE(marked(50.0));
  costmap.clearObstacles();
  EXPECT_FALSE(marked(50.1));
  ASSERT_FALSE(costmap.addScan(beamFrom(1.0, 2.02, 1.02F, 50.2)));
  costmap.setPrediction(prediction({walker("anna", {2.0, 2.0}, {0.5, 0.0})}, 50.2));
  EXPECT_TRUE(marked(50.2));
  EXPECT_FALSE(marked(3.0));
  EXPECT_EQ(PredictionStatus::kExpired, costmap.snapshot()->social.status);
}

TEST(TimedCostmap, expiresPeopleWhenThePredictorStops) {
  TimedCostmap costmap{CostmapParams{}};
  costmap.setMap(testing::emptyMap(80, 80));
  costmap.setPrediction(prediction({walker("anna", {2.0, 2.0}, {0.5, 0.0})}, 10.0));
  EXPECT_GT(testing::paintedCells(costmap.update({}, 10.5)->layers[0].cells), 0);
  EXPECT_EQ(0, testing::paintedCells(costmap.update({}, 11.5)->layers[0].cells));
  EXPECT_EQ(PredictionStatus::kExpired, costmap.snapshot()->social.status);
}

TEST(TimedCostmap, refusesBadParametersByName) {
  CostmapParams params;
  params.social_layers.variance_x = -1.0;
  params.inflation_layer.inscribed_radius = 3.0;
  try {
    TimedCostmap costmap{params};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("social/variance_x"));
    EXPECT_NE(std::string::npos, std::string(error.what()).find("inflation/inscribed_radius"));
  }
  TimedCostmap costmap{CostmapParams{}};
  EXPECT_THROW(costmap.setSocialParams(params.social_layers), std::invalid_argument);
  EXPECT_THROW(costmap.setMap({}), std::invalid_argument);
  sarn::OccupancyMap short_map = testing::emptyMap(5, 5);
  short_map.cells.pop_back();
  EXPECT_THROW(costmap.setMap(short_map), std::invalid_argument);
}

TEST(TimedCostmap, isReadWhileItIsUpdated) {
  TimedCostmap costmap{CostmapParams{}};
  costmap.setMap(testing::emptyMap(60, 60));
  std::atomic<bool> done{false};
  std::atomic<int> torn{0};
  const auto read = [&] {
    while (!done) {
      const auto snapshot = costmap.snapshot();
      if (!snapshot) continue;
      const sarn::TimedCostmapView view = snapshot->view();
      for (const std::uint8_t* layer : view.layers) {  // all layers hold one person who stands: all alike
        const auto sum = [&](const std::uint8_t* cells) {
          return std::accumulate(cells, cells + view.geometry.size(), 0);
        };
        if (sum(layer) != sum(view.layers[0])) ++torn;
      }
    }
  };
  std::thread planner(read);
  std::thread visualiser(read);
  SocialParams steady;
  steady.extrapolation_sigma_rate = 0.0;
  std::thread scanner([&] {
    for (int i = 0; !done; ++i)
      (void)costmap.addScan(beamFrom(1.0, 1.0, 0.01F * static_cast<float>(i % 200), 0.0));
  });
  for (int i = 0; i < 300; ++i) {
    if (i % 50 == 0) costmap.setMap(testing::emptyMap(60 + i / 10, 60));
    costmap.setSocialParams(steady);
    costmap.setPrediction(prediction({walker("anna", {1.0 + 0.005 * i, 1.5}, {0.0, 0.0})}, 0.05 * i));
    costmap.update({0.5, 0.5, 0.0}, 0.05 * i);
  }
  done = true;
  planner.join();
  visualiser.join();
  scanner.join();
  EXPECT_EQ(0, torn);
}

}  // namespace
}  // namespace social_costmap
