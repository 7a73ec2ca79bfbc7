// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/person_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.h"
#include "sarn_common/angles.h"

namespace social_costmap {
namespace {

sarn::PredictedState state(double x, double y, double heading, double speed = 1.0, double sigma = 0.0) {
  return {{x, y}, {speed * std::cos(heading), speed * std::sin(heading)}, sigma};
}

PersonPath pathOf(const sarn::PersonPrediction& person) {
  return {person, usableStates(person), 10.0, 0.5, SocialParams{}};
}

TEST(PersonPath, isLinearBetweenStates) {
  const sarn::PersonPrediction person{"a", "", {state(0, 0, 0, 1.0, 0.1), state(1, 2, 0, 2.0, 0.3)}};
  const PersonState middle = pathOf(person).at(10.25);
  EXPECT_DOUBLE_EQ(0.5, middle.position.x());
  EXPECT_DOUBLE_EQ(1.0, middle.position.y());
  EXPECT_DOUBLE_EQ(1.5, middle.speed);
  EXPECT_DOUBLE_EQ(0.2, middle.sigma);
}

TEST(PersonPath, turnsTheShorterWayRoundAcrossPi) {
  const sarn::PersonPrediction person{"a", "", {state(0, 0, 3.0), state(0, 0, -3.0)}};
  for (double t = 10.0; t <= 10.5; t += 0.05) {
    EXPECT_LT(std::abs(sarn::angleDifference(sarn::kPi, pathOf(person).at(t).heading)), 0.1416) << t;
  }
}

TEST(PersonPath, looksWhereHeWillGoWhenHeStands) {
  const sarn::PersonPrediction person{"a", "", {state(0, 0, 2.0, 0.05), state(0.2, 0, 0.0, 1.0)}};
  EXPECT_NEAR(0.0, pathOf(person).at(10.1).heading, 1e-12);
}

TEST(PersonPath, movesOnAfterTheLastStateAndGrowsUncertain) {
  const sarn::PersonPrediction person{"a", "", {state(0, 0, 0, 1.0, 0.1), state(0.5, 0, 0, 1.0, 0.2)}};
  const PersonState later = pathOf(person).at(12.5);
  EXPECT_NEAR(2.5, later.position.x(), 1e-12);
  EXPECT_NEAR(0.2 + 2.0 * 0.2, later.sigma, 1e-12) << "at the rate it grew last";
  const sarn::PersonPrediction single{"a", "", {state(0, 0, 0, 1.0, 0.1)}};
  EXPECT_NEAR(0.1 + 2.0 * 0.1, pathOf(single).at(12.0).sigma, 1e-12) << "at extrapolation_sigma_rate";
}

TEST(PersonPath, startsBeforeTheFirstState) {
  const sarn::PersonPrediction person{"a", "", {state(1, 0, 0, 1.0, 0.1), state(1.5, 0, 0, 1.0, 0.2)}};
  EXPECT_NEAR(0.8, pathOf(person).at(9.8).position.x(), 1e-9);
  EXPECT_NEAR(0.1, pathOf(person).at(9.8).sigma, 1e-12);
}

TEST(PersonPath, needsTwoSamplesForAStraightWay) {
  const auto person = testing::walker("a", {0, 0}, {1.0, 0.5});
  std::vector<PersonState> states;
  pathOf(person).sample(10.2, 10.7, 0.05, states);
  EXPECT_EQ(2U, states.size());
}

TEST(PersonPath, followsATurnInPieces) {
  sarn::PersonPrediction person{"a", "", {}};
  for (int i = 0; i < 8; ++i)
    person.states.push_back(state(std::sin(0.4 * i), 1 - std::cos(0.4 * i), 0.4 * i));
  std::vector<PersonState> states;
  const PersonPath path = pathOf(person);
  path.sample(10.2, 11.9, 0.02, states);
  ASSERT_GT(states.size(), 6U);
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    EXPECT_LE(std::abs(sarn::angleDifference(states[i].heading, states[i + 1].heading)), 0.21);
  }
  EXPECT_LT((states.front().position - path.at(10.2).position).norm(), 1e-12);
  EXPECT_LT((states.back().position - path.at(11.9).position).norm(), 1e-12);
}

TEST(PersonPath, countsOnlyTheStatesBeforeTheFirstBrokenOne) {
  auto person = testing::walker("a", {0, 0}, {1, 0}, 10);
  EXPECT_EQ(10U, usableStates(person));
  person.states[4].velocity.x() = testing::nan();
  EXPECT_EQ(4U, usableStates(person));
  person.states[0].position.y() = 1e300;
  EXPECT_EQ(0U, usableStates(person));
  EXPECT_EQ(0U, usableStates({}));
}

}  // namespace
}  // namespace social_costmap
