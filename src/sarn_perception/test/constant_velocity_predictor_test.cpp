// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/constant_velocity_predictor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sarn_perception {
namespace {

sarn::Person person(const std::string& name, double x, double y, double vx, double vy) {
  sarn::Person result;
  result.name = name;
  result.group = "queue";
  result.position = {x, y};
  result.velocity = {vx, vy};
  return result;
}

/// A 4 m x 2 m room of 0.1 m cells, free inside.
sarn::OccupancyMap room() {
  sarn::OccupancyMap map({40, 20, 0.1, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (x == 0 || y == 0 || x == 39 || y == 19) map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return map;
}

TEST(ConstantVelocityPredictor, extendsMotionFromNowOn) {
  ConstantVelocityPredictor predictor({});
  EXPECT_TRUE(predictor.observe({person("anna", 1.0, 2.0, 0.8, -0.4)}, 10.0).empty());
  const auto prediction = predictor.predict(10.25);
  EXPECT_DOUBLE_EQ(prediction.stamp, 10.25);
  EXPECT_DOUBLE_EQ(prediction.time_step, 0.5);
  ASSERT_EQ(prediction.people.size(), 1U);
  EXPECT_EQ(prediction.people[0].name, "anna");
  EXPECT_EQ(prediction.people[0].group, "queue");
  ASSERT_EQ(prediction.people[0].states.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const double t = 0.25 + 0.5 * static_cast<double>(i);
    EXPECT_NEAR(prediction.people[0].states[i].position.x(), 1.0 + 0.8 * t, 1e-9);
    EXPECT_NEAR(prediction.people[0].states[i].position.y(), 2.0 - 0.4 * t, 1e-9);
    EXPECT_EQ(prediction.people[0].states[i].velocity, Eigen::Vector2d(0.8, -0.4));
  }
}

TEST(PredictionSigma, followsTheFormula) {
  PredictionParams params;
  params.position_sigma = 0.1;
  params.velocity_sigma = 0.2;
  params.acceleration_density = 0.03;
  params.standing_sigma = 0.05;
  params.max_sigma = 100.0;
  EXPECT_DOUBLE_EQ(predictionSigma(params, true, 0.0), 0.1);
  EXPECT_NEAR(predictionSigma(params, true, 3.0), std::sqrt(0.01 + 0.36 + 0.27), 1e-12);
  EXPECT_NEAR(predictionSigma(params, false, 3.0), std::sqrt(0.01 + 0.0225), 1e-12);
  params.max_sigma = 0.5;
  EXPECT_DOUBLE_EQ(predictionSigma(params, true, 3.0), 0.5);
}

TEST(ConstantVelocityPredictor, growsLessCertain) {
  ConstantVelocityPredictor predictor({});
  (void)predictor.observe({person("anna", 0.0, 0.0, 1.0, 0.0)}, 0.0);
  const auto states = predictor.predict(0.0).people.at(0).states;
  EXPECT_DOUBLE_EQ(states.front().sigma, PredictionParams{}.position_sigma);
  for (std::size_t i = 1; i < states.size(); ++i) EXPECT_GE(states[i].sigma, states[i - 1].sigma);
  EXPECT_GT(states[10].sigma, states[0].sigma);
}

TEST(ConstantVelocityPredictor, letsSlowPeopleStand) {
  ConstantVelocityPredictor predictor({});
  (void)predictor.observe({person("anna", 1.0, 1.0, 0.1, 0.1)}, 0.0);
  const auto states = predictor.predict(0.0).people.at(0).states;
  EXPECT_EQ(states.back().position, Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(states.back().velocity, Eigen::Vector2d(0.0, 0.0));
}

TEST(ConstantVelocityPredictor, forgetsPeopleByStamp) {
  ConstantVelocityPredictor predictor({});  // after 1 s
  (void)predictor.observe({person("anna", 1.0, 1.0, 0.0, 0.0)}, 5.0);
  (void)predictor.observe({person("bert", 2.0, 1.0, 0.0, 0.0)}, 5.5);
  EXPECT_EQ(predictor.predict(5.9).people.size(), 2U);
  EXPECT_EQ(predictor.predict(6.1).people.at(0).name, "bert");
  EXPECT_EQ(predictor.predict(6.6).people.size(), 0U);
  EXPECT_EQ(predictor.size(), 0U);
}

TEST(ConstantVelocityPredictor, refusesWhatItCannotUseAndSaysSo) {
  ConstantVelocityPredictor predictor({});
  const auto lines = predictor.observe(
      {person("anna", 1.0, 1.0, 0.0, 0.0), person("anna", 5.0, 5.0, 0.0, 0.0),
       person("bert", std::nan(""), 1.0, 0.0, 0.0), person("cora", 1.0, 1.0, HUGE_VAL, 0.0)},
      1.0);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NE(lines[0].find("anna"), std::string::npos);
  EXPECT_NE(lines[1].find("bert"), std::string::npos);
  const auto prediction = predictor.predict(1.0);
  ASSERT_EQ(prediction.people.size(), 1U);
  EXPECT_EQ(prediction.people[0].states[0].position, Eigen::Vector2d(1.0, 1.0));
}

TEST(ConstantVelocityPredictor, keepsTheLatestMeasurement) {
  ConstantVelocityPredictor predictor({});
  (void)predictor.observe({person("anna", 2.0, 0.0, 0.0, 0.0)}, 1.0);
  EXPECT_EQ(predictor.observe({person("anna", 9.0, 0.0, 0.0, 0.0)}, 0.5).size(), 1U);
  EXPECT_EQ(predictor.predict(1.0).people.at(0).states[0].position, Eigen::Vector2d(2.0, 0.0));
}

TEST(ConstantVelocityPredictor, replacesPeopleWithoutNames) {
  ConstantVelocityPredictor predictor({});
  (void)predictor.observe({person("", 1.0, 0.0, 0.0, 0.0), person("", 2.0, 0.0, 0.0, 0.0)}, 1.0);
  EXPECT_EQ(predictor.predict(1.0).people.size(), 2U);
  (void)predictor.observe({person("", 3.0, 0.0, 0.0, 0.0)}, 1.1);
  const auto people = predictor.predict(1.1).people;
  ASSERT_EQ(people.size(), 1U);
  EXPECT_DOUBLE_EQ(people[0].states[0].position.x(), 3.0);
}

TEST(ConstantVelocityPredictor, stopsPeopleAtWalls) {
  PredictionParams params;
  params.walls = "stop";
  ConstantVelocityPredictor predictor(params);
  predictor.setMap(room());
  (void)predictor.observe({person("anna", 1.0, 1.0, 1.0, 0.1)}, 0.0);
  const auto states = predictor.predict(0.0).people.at(0).states;
  EXPECT_NEAR(states[4].position.x(), 3.0, 1e-6);
  EXPECT_LT(states.back().position.x(), 3.95 - 0.1);  // the wall's cell centre is at 3.95
  EXPECT_GT(states.back().position.x(), 3.5);
  EXPECT_EQ(states.back().velocity, Eigen::Vector2d(0.0, 0.0));
}

TEST(ConstantVelocityPredictor, letsPeopleSlideAlongWalls) {
  ConstantVelocityPredictor predictor({});
  predictor.setMap(room());
  (void)predictor.observe({person("anna", 0.5, 1.0, 0.6, 0.4)}, 0.0);
  const auto states = predictor.predict(0.0).people.at(0).states;
  EXPECT_NEAR(states[8].position.x(), 0.5 + 0.6 * 4.0, 0.05) << "still on its way along the upper wall";
  EXPECT_EQ(states[8].velocity, Eigen::Vector2d(0.6, 0.0));
  for (const auto& state : states) {
    EXPECT_GT(state.position.x(), 0.1);
    EXPECT_LT(state.position.x(), 3.9);
    EXPECT_LT(state.position.y(), 1.9);
  }
}

TEST(ConstantVelocityPredictor, ignoresWallsWhenTold) {
  PredictionParams params;
  params.walls = "ignore";
  ConstantVelocityPredictor predictor(params);
  predictor.setMap(room());
  (void)predictor.observe({person("anna", 1.0, 1.0, 1.0, 0.0)}, 0.0);
  EXPECT_NEAR(predictor.predict(0.0).people.at(0).states.back().position.x(), 10.5, 1e-9);
}

TEST(Walk, neverEntersAWall) {
  const WallField walls(room());
  for (const bool slide : {false, true}) {
    for (int i = 0; i < 64; ++i) {
      const double angle = 0.1 * i;
      Walker walker{{2.0, 1.0}, {1.7 * std::cos(angle), 1.7 * std::sin(angle)}};
      for (int k = 0; k < 20; ++k) {
        walk(walls, 0.2, slide, 0.5, walker);
        EXPECT_GT(walls.distance(walker.position), 0.0) << angle;
      }
    }
  }
}

TEST(Walk, letsSomebodyAtAWallWalkAway) {
  const WallField walls(room());
  Walker walker{{0.15, 1.0}, {1.0, 0.0}};
  walk(walls, 0.3, false, 1.0, walker);
  EXPECT_NEAR(walker.position.x(), 1.15, 1e-9);
}

}  // namespace
}  // namespace sarn_perception
