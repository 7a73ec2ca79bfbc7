// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/social_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fixtures.h"
#include "sarn_common/cost_values.h"
#include "sarn_common/timed_costmap_view.h"

namespace social_costmap {
namespace {

using testing::prediction;
using testing::walker;

const sarn::GridGeometry kGrid{200, 200, 0.05, 0.0, 0.0};  // 10 x 10 m

SocialLayers makeLayers(const SocialParams& params = {}) {
  SocialLayers layers(params);
  layers.resize(kGrid);
  return layers;
}

int costAt(const SocialLayers& layers, int layer, double x, double y) {
  return layers.timeLayers()[static_cast<std::size_t>(layer)].cells[kGrid.index(*kGrid.cellAt(x, y))];
}

std::vector<std::vector<std::uint8_t>> cellsOf(const SocialLayers& layers) {
  std::vector<std::vector<std::uint8_t>> all;
  for (const TimeLayer& layer : layers.timeLayers()) all.push_back(layer.cells);
  return all;
}

int allPainted(const SocialLayers& layers) {
  int count = 0;
  for (const TimeLayer& layer : layers.timeLayers()) count += testing::paintedCells(layer.cells);
  return count;
}

TEST(SocialLayers, holdsInLayerIThePeopleFromStepIToTheNext) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("anna", {1.0, 5.0}, {1.0, 0.0})}), 10.0);
  for (int i = 0; i < 10; ++i) {
    const double x = 1.0 + 0.5 * i;
    for (const double on_the_way : {0.0, 0.25, 0.49})
      EXPECT_EQ(254, costAt(layers, i, x + on_the_way, 5.0)) << i;
    EXPECT_NE(254, costAt(layers, i, x + 1.1, 5.0)) << "0.6 m after the end";
    if (x > 1.0) {
      EXPECT_NE(254, costAt(layers, i, x - 0.6, 5.0)) << "0.6 m before the start";
    }
  }
}

TEST(SocialLayers, startsAtTheGivenTime) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("anna", {1.0, 5.0}, {1.0, 0.0})}), 10.8);
  EXPECT_EQ(254, costAt(layers, 0, 1.8, 5.0));
  EXPECT_EQ(254, costAt(layers, 0, 2.29, 5.0));
  EXPECT_NE(254, costAt(layers, 0, 1.2, 5.0));
}

TEST(SocialLayers, movesPeopleOverTheWholeHorizon) {
  SocialParams params;
  params.forbidden_sigma_limit = 0.0;  // however uncertain
  SocialLayers layers = makeLayers(params);
  layers.update(prediction({walker("anna", {0.5, 5.0}, {0.5, 0.0}, 4)}), 10.0);  // four states, thirty layers
  for (int i = 0; i < 30; ++i) EXPECT_EQ(254, costAt(layers, i, 0.5 + 0.25 * i, 5.0)) << i;
  const int near = *std::max_element(layers.timeLayers()[2].cells.begin(), layers.timeLayers()[2].cells.end(),
                                     [](int a, int b) { return a % 254 < b % 254; });
  const int far =
      *std::max_element(layers.timeLayers()[29].cells.begin(), layers.timeLayers()[29].cells.end(),
                        [](int a, int b) { return a % 254 < b % 254; });
  EXPECT_LT(far, near) << "the Gaussian flattens as it gets uncertain";
}

TEST(SocialLayers, matchesTheFormulaEverywhere) {
  SocialLayers layers = makeLayers();
  const sarn::PersonPrediction person = walker("anna", {4.0, 5.0}, {0.6, 0.4}, 20, 0.2);
  layers.update(prediction({person}), 10.0);
  const SocialParams params;
  const PersonPath path(person, person.states.size(), 10.0, 0.5, params);
  for (const int layer : {0, 3, 7}) {
    const PersonState from = path.at(10.0 + 0.5 * layer);
    const PersonState to = path.at(10.5 + 0.5 * layer);
    const SweptGaussian gaussian = gaussianOf(params, from, to, layer);
    for (int y = 0; y < kGrid.height; ++y) {
      for (int x = 0; x < kGrid.width; ++x) {
        const int cost = layers.timeLayers()[static_cast<std::size_t>(layer)].cells[kGrid.index({x, y})];
        const double expected = social_costmap::costAt(gaussian, kGrid.center({x, y}));
        if (cost == 254) continue;
        if (expected > 10.1) {
          ASSERT_NEAR(std::floor(expected), cost, 1.0);
        }
        if (expected < 9.9) {
          ASSERT_EQ(0, cost);
        }
      }
    }
  }
}

TEST(SocialLayers, turnsWithTheWorld) {
  SocialLayers layers = makeLayers();
  const sarn::Pose2D quarter{10.0, 0.0,
                             sarn::kPi / 2};  // about the centre of the grid: (x, y) -> (10 - y, x)
  const auto people = prediction({walker("anna", {4.0, 5.0}, {0.7, 0.3}, 20, 0.1, "pair"),
                                  walker("bert", {4.1, 6.0}, {0.7, 0.3}, 20, 0.1, "pair"),
                                  walker("carl", {7.0, 2.0}, {0.0, 0.0}, 20, 0.1)});
  layers.update(people, 10.0);
  SocialLayers turned = makeLayers();
  turned.update(transformed(quarter, people), 10.0);
  for (std::size_t layer = 0; layer < layers.timeLayers().size(); ++layer) {
    for (int y = 0; y < kGrid.height; ++y) {
      for (int x = 0; x < kGrid.width; ++x) {
        const int a = layers.timeLayers()[layer].cells[kGrid.index({x, y})];
        const int b = turned.timeLayers()[layer].cells[kGrid.index({kGrid.width - 1 - y, x})];
        if (a == 254 || b == 254 || a == 0 || b == 0) continue;  // edges may fall on either side
        ASSERT_NEAR(a, b, 1) << layer << ": " << x << ", " << y;
      }
    }
  }
}

TEST(SocialLayers, moveTheWorldByWholeCellsAndTheCostsMoveAlong) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("anna", {4.0, 5.0}, {0.0, 0.0})}), 10.0);
  SocialLayers moved = makeLayers();
  moved.update(prediction({walker("anna", {5.0, 5.5}, {0.0, 0.0})}), 10.0);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 180; ++x) {
      ASSERT_NEAR(layers.timeLayers()[0].cells[kGrid.index({x, y})],
                  moved.timeLayers()[0].cells[kGrid.index({x + 20, y + 10})], 1);
    }
  }
}

TEST(SocialLayers, leavesNoTrailOver200Updates) {
  SocialLayers layers = makeLayers();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::vector<Eigen::Vector2d> position(8);
  for (auto& p : position) p = {5.0 + 4.0 * u(random), 5.0 + 4.0 * u(random)};
  for (int step = 0; step < 200; ++step) {
    std::vector<sarn::PersonPrediction> people;
    for (std::size_t i = 0; i < position.size(); ++i) {
      const Eigen::Vector2d velocity(u(random), u(random));
      position[i] += 0.3 * velocity;
      if (random() % 6 == 0) continue;  // sometimes unseen
      people.push_back(walker(std::to_string(i), position[i], velocity, 5, 0.1, i < 3 ? "group" : ""));
    }
    layers.update(prediction(people, 0.1 * step), 0.1 * step);
    if (step % 20 != 19) continue;
    SocialLayers fresh = makeLayers();
    fresh.update(prediction(people, 0.1 * step), 0.1 * step);
    ASSERT_EQ(cellsOf(fresh), cellsOf(layers)) << "step " << step;
  }
}

TEST(SocialLayers, touchesOnlyWhatItPaints) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("anna", {1.0, 5.0}, {1.0, 0.0})}), 10.0);
  for (const TimeLayer& layer : layers.timeLayers()) {
    for (int y = 0; y < kGrid.height; ++y) {
      for (int x = 0; x < kGrid.width; ++x) {
        if (layer.cells[kGrid.index({x, y})] == 0) continue;
        ASSERT_TRUE(std::any_of(layer.painted.begin(), layer.painted.end(),
                                [&](const CellRect& r) { return r.contains({x, y}); }));
      }
    }
    ASSERT_LE(layer.painted.size(), 1U);
  }
}

// A mark on a cell that nobody comes near stands for all of them: clearing whole maps would wipe it out.
TEST(SocialLayers, writesNothingWhereNobodyIs) {
  constexpr std::uint8_t kMark = 77;
  const std::size_t far_away = kGrid.index({2, kGrid.height - 3});
  SocialLayers layers = makeLayers();
  for (const std::uint8_t* layer : layers.layers()) const_cast<std::uint8_t*>(layer)[far_away] = kMark;
  for (int i = 0; i < 5; ++i) {
    layers.update(prediction({walker("anna", {1.0 + 0.3 * i, 1.0}, {0.4, 0.0})}), 10.0);
    for (const TimeLayer& layer : layers.timeLayers()) {
      ASSERT_FALSE(layer.painted.empty());
      ASSERT_EQ(layer.cells[far_away], kMark);
    }
  }
  layers.clear();
  for (const TimeLayer& layer : layers.timeLayers()) {
    EXPECT_EQ(layer.cells[far_away], kMark);
    EXPECT_EQ(std::count_if(layer.cells.begin(), layer.cells.end(), [](int cost) { return cost != 0; }), 1);
  }
}

TEST(SocialLayers, givesTheSameCostsInAnyOrderOfPeople) {
  std::vector<sarn::PersonPrediction> people;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0.0, 10.0);
  for (int i = 0; i < 12; ++i) {
    people.push_back(walker(std::to_string(i), {u(random), u(random)}, {0.3, -0.2}, 1 + i % 5, 0.1,
                            i % 3 == 0 ? "g" : ""));
  }
  SocialLayers layers = makeLayers();
  layers.update(prediction(people), 10.0);
  const auto expected = cellsOf(layers);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(people.begin(), people.end(), random);
    layers.update(prediction(people), 10.0);
    ASSERT_EQ(expected, cellsOf(layers));
  }
}

TEST(SocialLayers, acceptsDuplicateNames) {
  SocialLayers layers = makeLayers();
  const auto anna = walker("anna", {3.0, 5.0}, {0.5, 0.0});
  layers.update(prediction({anna}), 10.0);
  const auto once = cellsOf(layers);
  layers.update(prediction({anna, anna}), 10.0);
  EXPECT_EQ(once, cellsOf(layers));
  layers.update(prediction({anna, walker("anna", {7.0, 5.0}, {0.0, 0.0})}), 10.0);
  EXPECT_EQ(254, costAt(layers, 0, 3.0, 5.0));
  EXPECT_EQ(254, costAt(layers, 0, 7.0, 5.0)) << "in doubt there is somebody at both places";
}

TEST(SocialLayers, keepsPeopleWithFewerStatesThanOthers) {
  SocialParams params;
  params.forbidden_sigma_limit = 0.0;  // however uncertain
  SocialLayers layers = makeLayers(params);
  layers.update(prediction({walker("anna", {2.0, 2.0}, {0, 0}, 20), walker("bert", {5.0, 5.0}, {0, 0}, 1),
                            walker("carl", {8.0, 8.0}, {0, 0}, 3), walker("dora", {8.0, 2.0}, {0, 0}, 0)}),
                10.0);
  for (const int layer : {0, 5, 25}) {
    EXPECT_EQ(254, costAt(layers, layer, 2.0, 2.0));
    EXPECT_EQ(254, costAt(layers, layer, 5.0, 5.0));
    EXPECT_EQ(254, costAt(layers, layer, 8.0, 8.0));
    EXPECT_EQ(0, costAt(layers, layer, 8.0, 2.0));
  }
}

TEST(SocialLayers, showsNobodyAfterTheTimeout) {
  SocialLayers layers = makeLayers();
  const auto people = prediction({walker("anna", {3.0, 5.0}, {0.5, 0.0})}, 10.0);
  EXPECT_EQ(PredictionStatus::kUsed, layers.update(people, 10.9).status);
  EXPECT_GT(allPainted(layers), 0);
  EXPECT_EQ(PredictionStatus::kExpired, layers.update(people, 11.1).status);
  EXPECT_EQ(0, allPainted(layers));
  EXPECT_EQ(PredictionStatus::kFromFuture, layers.update(people, 8.0).status);
  EXPECT_EQ(0, allPainted(layers));
}

TEST(SocialLayers, showsNobodyWhenDisabled) {
  SocialLayers layers = makeLayers();
  const auto people = prediction({walker("anna", {3.0, 5.0}, {0.5, 0.0})});
  layers.update(people, 10.0);
  SocialParams off;
  off.enabled = false;
  layers.setParams(off);
  EXPECT_EQ(PredictionStatus::kDisabled, layers.update(people, 10.0).status);
  EXPECT_EQ(0, allPainted(layers));
}

TEST(SocialLayers, takesNewParametersWithoutLosingOrLeakingAnything) {
  SocialLayers layers = makeLayers();
  const auto people = prediction({walker("anna", {3.0, 5.0}, {0.5, 0.0})});
  layers.update(people, 10.0);
  SocialParams params;
  params.num_layers = 12;
  params.amplitude_multiplicator = 100.0;
  layers.setParams(params);
  layers.update(people, 10.0);
  SocialLayers fresh = makeLayers(params);
  fresh.update(people, 10.0);
  EXPECT_EQ(cellsOf(fresh), cellsOf(layers));
}

TEST(SocialLayers, makesAQueueDearButCrossable) {
  SocialLayers layers = makeLayers();
  std::vector<sarn::PersonPrediction> queue;
  for (int i = 0; i < 4; ++i)
    queue.push_back(walker(std::to_string(i), {2.0 + 1.5 * i, 5.0}, {0, 0}, 20, 0.0, "queue"));
  layers.update(prediction(queue), 10.0);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(180, costAt(layers, 0, 2.75 + 1.5 * i, 5.0), 45) << "between two";
  for (int i = 0; i < 3; ++i) EXPECT_LT(costAt(layers, 0, 2.75 + 1.5 * i, 5.0), 253);
  EXPECT_EQ(0, costAt(layers, 0, 4.25, 7.0)) << "room to go round";
  for (auto& person : queue) person.group.clear();
  layers.update(prediction(queue), 10.0);
  EXPECT_LT(costAt(layers, 0, 2.75, 5.0), 130) << "strangers may be passed between";
}

TEST(SocialLayers, makesTheMiddleOfATalkingGroupDear) {
  SocialLayers layers = makeLayers();
  std::vector<sarn::PersonPrediction> group;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * sarn::kPi * i / 5.0;
    group.push_back(walker(std::to_string(i), {5.0 + 1.5 * std::cos(angle), 5.0 + 1.5 * std::sin(angle)},
                           {0, 0}, 20, 0.0, "talk"));
  }
  layers.update(prediction(group), 10.0);
  EXPECT_EQ(180, costAt(layers, 0, 5.02, 5.02));
  for (auto& person : group) person.group.clear();
  layers.update(prediction(group), 10.0);
  EXPECT_LT(costAt(layers, 0, 5.02, 5.02), 30);
}

TEST(SocialLayers, keepsGroupsApartByName) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("a", {4.0, 5.0}, {0, 0}, 20, 0.0, "one"),
                            walker("b", {5.8, 5.0}, {0, 0}, 20, 0.0, "two")}),
                10.0);
  const int apart = costAt(layers, 0, 4.9, 5.0);
  layers.update(prediction({walker("a", {4.0, 5.0}, {0, 0}, 20, 0.0, "one"),
                            walker("b", {5.8, 5.0}, {0, 0}, 20, 0.0, "one")}),
                10.0);
  EXPECT_GT(costAt(layers, 0, 4.9, 5.0), apart + 50);
}

TEST(SocialLayers, giveThePlannerAViewByTime) {
  SocialLayers layers = makeLayers();
  layers.update(prediction({walker("anna", {1.0, 5.0}, {1.0, 0.0})}), 10.0);
  const auto pointers = layers.layers();
  ASSERT_EQ(30U, pointers.size());
  for (std::size_t i = 0; i < pointers.size(); ++i)
    EXPECT_EQ(layers.timeLayers()[i].cells.data(), pointers[i]);
}

}  // namespace
}  // namespace social_costmap
