// SPDX-License-Identifier: BSD-3-Clause
// The suite that every costmap layer passes: it keeps to its bounds, leaves no trace, follows the size, and
// what it updates piece by piece equals what it computes afresh.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>

#include "fixtures.h"
#include "social_costmap/inflation_layer.h"
#include "social_costmap/layered_costmap.h"
#include "social_costmap/obstacle_layer.h"
#include "social_costmap/social_layer.h"
#include "social_costmap/static_layer.h"

namespace social_costmap {
namespace {

constexpr int kSteps = 200;

/// A layer under test with what makes it change from step to step.
struct Subject {
  std::unique_ptr<Layer> layer;
  std::function<void(int)> change;
  bool forgets = true;  // reset() leaves nothing
};

sarn::OccupancyMap randomMap(unsigned seed, int size) {
  std::mt19937 random(seed);
  sarn::OccupancyMap map = testing::emptyMap(size, size);
  for (auto& cell : map.cells) {
    const auto draw = random() % 40;
    cell = draw == 0 ? sarn::kMapOccupied : draw == 1 ? sarn::kMapUnknown : sarn::kMapFree;
  }
  return map;
}

Subject staticSubject() {
  auto layer = std::make_unique<StaticLayer>(StaticLayerParams{});
  layer->setMap(randomMap(1, 60));
  StaticLayer* raw = layer.get();
  return {std::move(layer), [raw](int step) { raw->setMap(randomMap(static_cast<unsigned>(step % 7), 60)); },
          false};
}

Subject inflationSubject() {
  return {std::make_unique<InflationLayer>(InflationLayerParams{}), [](int) {}, true};
}

Subject obstacleSubject() {
  auto layer = std::make_unique<ObstacleLayer>(ObstacleLayerParams{});
  ObstacleLayer* raw = layer.get();
  return {std::move(layer),
          [raw](int step) {
            std::mt19937 random(static_cast<unsigned>(step));
            std::uniform_real_distribution<double> range(0.0, 4.0);
            Scan scan{{1.5, 1.5, 0.1 * step}, -0.5, 0.01, 0.1, 10.0, 0.1 * step, std::vector<float>(100)};
            for (auto& r : scan.ranges) r = static_cast<float>(range(random));
            ASSERT_FALSE(raw->addScan(scan));
          },
          true};
}

Subject socialSubject() {
  auto layer = std::make_unique<SocialLayer>(SocialParams{});
  SocialLayer* raw = layer.get();
  return {std::move(layer),
          [raw](int step) {
            std::mt19937 random(static_cast<unsigned>(step));
            std::uniform_real_distribution<double> place(-1.0, 4.0);
            std::vector<sarn::PersonPrediction> people;
            const auto count = step % 5 == 4 ? 0 : 1 + random() % 3;
            for (std::size_t i = 0; i < count; ++i) {
              people.push_back(testing::walker("p", {place(random), place(random)}, {place(random), 0.3}));
            }
            raw->setPrediction(testing::prediction(people, 0.1 * step));
          },
          true};
}

using MakeSubject = Subject (*)();
class LayerSuite : public ::testing::TestWithParam<MakeSubject> {
 protected:
  // Walls that move, so that layers that work on what lies below them have something to do.
  static std::unique_ptr<StaticLayer> base() {
    auto layer = std::make_unique<StaticLayer>(StaticLayerParams{}, "base");
    layer->setMap(randomMap(3, 60));
    return layer;
  }
  static UpdateContext at(int step) { return {{1.0 + 0.005 * step, 1.5, 0.0}, 0.1 * step}; }
  sarn::GridGeometry geometry_{60, 60, 0.05, 0.0, 0.0};
};

TEST_P(LayerSuite, changesNothingOutsideItsBounds) {
  Subject subject = GetParam()();
  LayeredCostmap costmap;
  costmap.addLayer(base());
  costmap.addLayer(std::move(subject.layer));
  costmap.resize(geometry_);
  for (int step = 0; step < kSteps; ++step) {
    const CostGrid before = costmap.master();
    subject.change(step);
    const CellRect bounds = costmap.update(at(step));
    for (int y = 0; y < geometry_.height; ++y) {
      for (int x = 0; x < geometry_.width; ++x) {
        if (bounds.contains({x, y})) continue;
        ASSERT_EQ(before.at({x, y}), costmap.master().at({x, y}))
            << "step " << step << " cell " << x << ", " << y;
      }
    }
  }
}

TEST_P(LayerSuite, writesOnlyInsideTheBoundsItIsGiven) {
  Subject subject = GetParam()();
  subject.layer->matchSize(geometry_);
  subject.change(5);
  CellRect wanted;
  subject.layer->updateBounds(at(5), wanted);
  CostGrid master(geometry_, sarn::kFreeSpace);
  for (int x = 10; x < 40; ++x) master.at({x, 25}) = sarn::kLethalObstacle;
  const CostGrid before = master;
  const CellRect given{20, 20, 33, 31};
  subject.layer->updateCosts(master, given);
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      if (!given.contains({x, y})) {
        ASSERT_EQ(before.at({x, y}), master.at({x, y})) << x << ", " << y;
      }
    }
  }
}

TEST_P(LayerSuite, updatesPieceByPieceToWhatAFreshCostmapHolds) {
  Subject subject = GetParam()();
  LayeredCostmap costmap;
  costmap.addLayer(base());
  costmap.addLayer(std::move(subject.layer));
  costmap.addLayer(std::make_unique<InflationLayer>(InflationLayerParams{}, "top"));
  costmap.resize(geometry_);
  Layer* toggled = nullptr;
  auto extra = std::make_unique<InflationLayer>(InflationLayerParams{}, "toggled");
  toggled = extra.get();
  costmap.addLayer(std::move(extra));
  for (int step = 0; step < kSteps; ++step) {
    subject.change(step);
    costmap.update(at(step));
    const CostGrid incremental = costmap.master();
    toggled->setEnabled(!toggled->enabled());  // a toggled layer makes the costmap recompute every cell
    costmap.update(at(step));
    ASSERT_EQ(incremental.cells, costmap.master().cells) << "step " << step;
  }
}

TEST_P(LayerSuite, leavesNoTraceWhenDisabled) {
  Subject subject = GetParam()();
  LayeredCostmap plain;
  plain.addLayer(base());
  plain.resize(geometry_);
  plain.update(at(0));

  LayeredCostmap costmap;
  costmap.addLayer(base());
  Layer& layer = costmap.addLayer(std::move(subject.layer));
  costmap.resize(geometry_);
  subject.change(0);
  costmap.update(at(0));
  ASSERT_NE(plain.master().cells, costmap.master().cells);
  layer.setEnabled(false);
  costmap.update(at(0));
  EXPECT_EQ(plain.master().cells, costmap.master().cells);
  layer.setEnabled(true);
  costmap.update(at(0));
  EXPECT_NE(plain.master().cells, costmap.master().cells);
}

TEST_P(LayerSuite, forgetsWhatItObservedOnReset) {
  Subject subject = GetParam()();
  LayeredCostmap costmap;
  costmap.addLayer(base());
  Layer& layer = costmap.addLayer(std::move(subject.layer));
  costmap.resize(geometry_);
  costmap.update(at(0));
  const CostGrid untouched = costmap.master();
  subject.change(0);
  costmap.update(at(0));
  layer.reset();
  costmap.update(at(0));
  if (subject.forgets) {
    EXPECT_EQ(untouched.cells, costmap.master().cells);
  } else {
    EXPECT_NE(untouched.cells, costmap.master().cells) << "the map stays";
  }
}

TEST_P(LayerSuite, followsTheSizeWhileRunning) {
  Subject subject = GetParam()();
  LayeredCostmap costmap;
  costmap.addLayer(std::move(subject.layer));
  int step = 0;
  for (const sarn::GridGeometry& geometry : {sarn::GridGeometry{60, 60, 0.05, 0.0, 0.0},
                                             {7, 3, 0.5, -1.0, -1.0},
                                             {1, 1, 0.05, 1.5, 1.5},
                                             {0, 0, 1.0, 0, 0},
                                             {90, 40, 0.02, 0.7, 1.1}}) {
    costmap.resize(geometry);
    EXPECT_EQ(geometry, costmap.geometry());
    for (int i = 0; i < 10; ++i) {
      subject.change(++step);
      const CellRect bounds = costmap.update(at(step));
      EXPECT_EQ(bounds, bounds.clipped(geometry));
      EXPECT_EQ(geometry.size(), costmap.master().cells.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Static, LayerSuite, ::testing::Values(staticSubject));
INSTANTIATE_TEST_SUITE_P(Obstacle, LayerSuite, ::testing::Values(obstacleSubject));
INSTANTIATE_TEST_SUITE_P(Inflation, LayerSuite, ::testing::Values(inflationSubject));
INSTANTIATE_TEST_SUITE_P(Social, LayerSuite, ::testing::Values(socialSubject));

}  // namespace
}  // namespace social_costmap
