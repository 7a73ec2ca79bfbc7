// SPDX-License-Identifier: BSD-3-Clause
// Inputs that crashed or hung the published implementation of Kollmitz et al. 2015, and random ones.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fixtures.h"
#include "social_costmap/social_layers.h"
#include "social_costmap/timed_costmap.h"

namespace social_costmap {
namespace {

using testing::prediction;
using testing::walker;

int allPainted(const SocialLayers& layers) {
  int count = 0;
  for (const TimeLayer& layer : layers.timeLayers()) count += testing::paintedCells(layer.cells);
  return count;
}

class Robustness : public ::testing::Test {
 protected:
  void SetUp() override { layers_.resize({100, 80, 0.05, -1.0, -2.0}); }
  SocialLayers layers_{SocialParams{}};
};

TEST_F(Robustness, ignoresPeopleBeyondEachEdgeOfTheMap) {
  for (const Eigen::Vector2d& outside :
       {Eigen::Vector2d(-8.0, 0.0), {12.0, 0.0}, {0.0, -9.0}, {0.0, 9.0}, {-1e5, -1e5}, {9e5, -9e5}}) {
    const SocialReport report = layers_.update(prediction({walker("a", outside, {0.0, 0.0})}), 10.0);
    EXPECT_EQ(1, report.people);
    EXPECT_EQ(0, allPainted(layers_));
  }
}

TEST_F(Robustness, clipsPeopleOnTheEdgeOfTheMap) {
  for (const Eigen::Vector2d& edge :
       {Eigen::Vector2d(-1.0, 0.0), {4.0, 0.0}, {0.0, -2.0}, {0.0, 2.0}, {-1.3, -2.3}, {4.2, 2.2}}) {
    layers_.update(prediction({walker("a", edge, {0.01, 0.0})}), 10.0);
    EXPECT_GT(allPainted(layers_), 0) << edge.transpose();
  }
}

TEST_F(Robustness, followsSomebodyOutOfTheMap) {
  layers_.update(prediction({walker("a", {0.0, 0.0}, {-2.0, -0.5})}), 10.0);
  EXPECT_GT(testing::paintedCells(layers_.timeLayers().front().cells), 0);
  EXPECT_EQ(0, testing::paintedCells(layers_.timeLayers().back().cells));
}

TEST_F(Robustness, countsAndIgnoresPeopleWhoAreNotFinite) {
  const double bad[] = {testing::nan(), std::numeric_limits<double>::infinity(), -1e300, 1e7};
  for (const double value : bad) {
    for (int field = 0; field < 4; ++field) {
      auto broken = walker("bad", {0.0, 0.0}, {0.0, 0.0});
      auto& first = broken.states.front();
      (field == 0   ? first.position.x()
       : field == 1 ? first.position.y()
       : field == 2 ? first.velocity.x()
                    : first.velocity.y()) = value;
      const SocialReport report =
          layers_.update(prediction({broken, walker("good", {1.0, 0.0}, {0.1, 0.0})}), 10.0);
      EXPECT_EQ(1, report.ignored_people);
      EXPECT_EQ(1, report.people);
      EXPECT_GT(allPainted(layers_), 0);
    }
  }
}

TEST_F(Robustness, showsNobodyForAMalformedPrediction) {
  auto people = prediction({walker("a", {0.0, 0.0}, {0.5, 0.0})});
  for (const double step : {0.0, -0.5, testing::nan(), std::numeric_limits<double>::infinity()}) {
    people.time_step = step;
    EXPECT_EQ(PredictionStatus::kMalformed, layers_.update(people, 10.0).status);
    EXPECT_EQ(0, allPainted(layers_));
  }
  people.time_step = 0.5;
  people.stamp = testing::nan();
  EXPECT_EQ(PredictionStatus::kMalformed, layers_.update(people, 10.0).status);
  people.stamp = 10.0;
  EXPECT_EQ(PredictionStatus::kMalformed, layers_.update(people, testing::nan()).status);
}

TEST_F(Robustness, survivesTimeStepsOfAnySize) {
  auto people = prediction({walker("a", {0.0, 0.0}, {0.5, 0.0})});
  for (const double step : {1e-300, 1e-9, 1e-3, 1e3, 1e300}) {
    people.time_step = step;
    EXPECT_EQ(PredictionStatus::kUsed, layers_.update(people, 10.0).status);
  }
}

TEST_F(Robustness, survivesEmptyGridAndNoPeople) {
  SocialLayers layers{SocialParams{}};
  layers.update(prediction({walker("a", {0.0, 0.0}, {0.5, 0.0})}), 10.0);
  EXPECT_EQ(0, allPainted(layers));
  EXPECT_EQ(PredictionStatus::kUsed, layers_.update(prediction({}), 10.0).status);
}

TEST_F(Robustness, shows200People) {
  std::vector<sarn::PersonPrediction> people;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    people.push_back(walker(std::to_string(i), {-1.0 + 5.0 * u(random), -2.0 + 4.0 * u(random)},
                            {u(random), u(random)}, 20, 0.1, "all"));
  }
  EXPECT_EQ(200, layers_.update(prediction(people), 10.0).people);
  EXPECT_GT(allPainted(layers_), 0);
}

sarn::PersonPrediction randomPerson(std::mt19937& random) {
  const auto number = [&random]() -> double {
    const auto draw = random() % 24;
    if (draw == 0) return testing::nan();
    if (draw == 1) return std::numeric_limits<double>::infinity();
    if (draw == 2) return -1e300;
    if (draw == 3) return 9.9e5;
    if (draw == 4) return 0.0;
    return -6.0 + 12.0 * (static_cast<double>(random() % 100000) / 1e5);
  };
  sarn::PersonPrediction person;
  person.name = "p" + std::to_string(random() % 4);
  person.group = random() % 2 == 0 ? "" : "g" + std::to_string(random() % 2);
  person.states.resize(random() % 8);
  for (auto& state : person.states) state = {{number(), number()}, {number(), number()}, number()};
  return person;
}

TEST_F(Robustness, survivesRandomPeopleWhileTheMapIsResized) {
  std::mt19937 random(77);
  for (int round = 0; round < 400; ++round) {
    if (random() % 10 == 0) {
      layers_.resize({static_cast<int>(random() % 90), static_cast<int>(random() % 70),
                      0.03 + 0.001 * static_cast<double>(random() % 100),
                      -3.0 + 0.01 * static_cast<double>(random() % 500), -2.0});
    }
    SocialParams params;
    params.num_layers = 1 + static_cast<int>(random() % 12);
    params.layer_duration = 0.1 + 0.1 * static_cast<double>(random() % 10);
    params.cutoff_amplitude = 1.0 + static_cast<double>(random() % 60);
    params.keep_amplitude = random() % 2 == 0;
    params.isotropic_standing = random() % 2 == 0;
    params.forbidden_radius = 0.1 * static_cast<double>(random() % 8);
    layers_.setParams(params);
    sarn::PeoplePrediction people = prediction({}, 10.0 + 0.01 * static_cast<double>(random() % 300));
    people.time_step = random() % 8 == 0 ? 1e-6 : 0.4;
    const auto count = random() % 9;
    for (std::size_t i = 0; i < count; ++i) people.people.push_back(randomPerson(random));
    layers_.update(people, 11.0);
    SocialLayers fresh(params);
    fresh.resize(layers_.geometry());
    fresh.update(people, 11.0);
    for (std::size_t i = 0; i < fresh.timeLayers().size(); ++i) {
      ASSERT_EQ(fresh.timeLayers()[i].cells, layers_.timeLayers()[i].cells) << "round " << round;
    }
  }
}

TEST_F(Robustness, survivesRandomScansAndPeopleInTheWholeCostmap) {
  std::mt19937 random(5);
  TimedCostmap costmap{CostmapParams{}};
  for (int round = 0; round < 150; ++round) {
    if (round % 30 == 0)
      costmap.setMap(testing::emptyMap(20 + static_cast<int>(random() % 100), 30 + round % 40));
    Scan scan{
        {0.1 * static_cast<double>(random() % 60) - 1.0, 1.0, 0.01 * static_cast<double>(random() % 628)},
        -1.0,
        0.02,
        0.1,
        random() % 5 == 0 ? std::numeric_limits<double>::infinity() : 10.0,
        0.1 * round,
        {}};
    for (int i = 0; i < 100; ++i) {
      const auto draw = random() % 12;
      scan.ranges.push_back(draw == 0   ? std::numeric_limits<float>::quiet_NaN()
                            : draw == 1 ? std::numeric_limits<float>::infinity()
                            : draw == 2 ? -1.0F
                            : draw == 3 ? 3e38F
                                        : 0.001F * static_cast<float>(random() % 5000));
    }
    EXPECT_FALSE(costmap.addScan(scan));
    sarn::PeoplePrediction people = prediction({}, 0.1 * round);
    std::vector<sarn::Person> seen;
    const auto count = random() % 6;
    for (std::size_t i = 0; i < count; ++i) {
      people.people.push_back(randomPerson(random));
      const auto& states = people.people.back().states;
      if (!states.empty()) seen.push_back({"p", "", states.front().position, states.front().velocity, 1.0});
    }
    costmap.setPeople(seen, 0.1 * round);
    costmap.setPrediction(people);
    ASSERT_TRUE(costmap.update({1.0, 1.0, 0.0}, 0.1 * round));
  }
}

}  // namespace
}  // namespace social_costmap
