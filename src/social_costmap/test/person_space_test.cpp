// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/person_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sarn_common/angles.h"
#include "sarn_common/pose2d.h"

namespace social_costmap {
namespace {

PersonState walking(double heading, double speed = 1.0, double sigma = 0.0) {
  return {{0.0, 0.0}, heading, speed, sigma};
}

double cost(const SocialParams& params, const PersonState& state, double x, double y) {
  return costAt(gaussianOf(params, state, state, 0), {x, y});
}

TEST(PersonSpace, followsTheFormula) {
  const SocialParams p;
  const PersonState person = walking(0.0, 0.5);
  const double ahead = p.variance_x * (1.0 + p.speed_variance_factor * 0.5);
  for (double x = -1.5; x <= 1.5; x += 0.25) {
    for (double y = -1.5; y <= 1.5; y += 0.25) {
      const double dx = x - p.offset_x;
      const double dy = y + p.offset_y;
      const double variance = dx > 0.0 ? ahead : p.variance_x;
      const double expected = 225.0 * std::exp(-dx * dx / (2.0 * variance) - dy * dy / (2.0 * p.variance_y));
      EXPECT_NEAR(expected, cost(p, person, x, y), 1e-9);
    }
  }
}

TEST(PersonSpace, turnsWithThePerson) {
  const SocialParams p;
  for (const double heading : {0.3, 2.0, -3.0, sarn::kPi}) {
    const sarn::Pose2D turn{0.0, 0.0, heading};
    for (const Eigen::Vector2d& point : {Eigen::Vector2d(0.7, 0.2), {-0.5, 0.4}, {0.1, -0.9}}) {
      const Eigen::Vector2d turned = turn * point;
      EXPECT_NEAR(cost(p, walking(0.0), point.x(), point.y()),
                  cost(p, walking(heading), turned.x(), turned.y()), 1e-9);
    }
  }
}

TEST(PersonSpace, isSymmetricAboutTheHeadingWithoutSideOffset) {
  SocialParams p;
  p.offset_y = 0.0;
  for (double x = -1.0; x <= 1.0; x += 0.2)
    EXPECT_DOUBLE_EQ(cost(p, walking(0.0), x, 0.6), cost(p, walking(0.0), x, -0.6));
}

// A person walks towards +x. Her right hand is at -y.
TEST(PersonSpace, makesThePersonsRightSideDearer) {
  const SocialParams p;
  for (double x = -0.8; x <= 1.6; x += 0.2) {
    EXPECT_LT(cost(p, walking(0.0), x, 0.7), cost(p, walking(0.0), x, -0.7)) << x;
  }
}

TEST(PersonSpace, makesItCheaperToKeepToTheRightOfAnOncomingPerson) {
  const SocialParams p;
  const PersonState oncoming = walking(sarn::kPi);  // robot drives towards +x, the robot's right is -y
  EXPECT_LT(cost(p, oncoming, 0.0, -0.7), cost(p, oncoming, 0.0, 0.7));
}

TEST(PersonSpace, makesItCheaperToOvertakeOnTheLeft) {
  const SocialParams p;
  const PersonState same_way = walking(0.0);  // robot drives towards +x, its left is +y
  EXPECT_LT(cost(p, same_way, 0.0, 0.7), cost(p, same_way, 0.0, -0.7));
}

TEST(PersonSpace, makesItCheaperToCrossBehindThanInFront) {
  const SocialParams p;
  EXPECT_LT(cost(p, walking(0.0), -0.8, 0.0), cost(p, walking(0.0), 0.8, 0.0));
  EXPECT_LT(cost(p, walking(0.0, 0.5), 1.2, 0.0), cost(p, walking(0.0, 1.5), 1.2, 0.0))
      << "more so when fast";
}

TEST(PersonSpace, isRoundAboutSomebodyWhoStands) {
  const SocialParams p;
  const PersonState standing{{0.0, 0.0}, 1.0, 0.1, 0.0};
  const double ahead = cost(p, standing, 0.7, 0.0);
  for (double angle = 0.0; angle < 6.3; angle += 0.5) {
    EXPECT_NEAR(ahead, cost(p, standing, 0.7 * std::cos(angle), 0.7 * std::sin(angle)), 1e-9);
  }
  SocialParams told;
  told.isotropic_standing = false;
  EXPECT_GT(cost(told, standing, 0.7 * std::cos(1.0), 0.7 * std::sin(1.0)),
            cost(told, standing, -0.7 * std::cos(1.0), -0.7 * std::sin(1.0)));
}

TEST(PersonSpace, spreadsUncertaintyAsTheExpectedCost) {
  SocialParams p;
  p.speed_variance_factor = 0.0;
  const SweptGaussian g = gaussianOf(p, walking(0.0, 1.0, 0.6), walking(0.0, 1.0, 0.6), 0);
  EXPECT_NEAR(std::sqrt(p.variance_x + 0.36), g.sigma_rear, 1e-12);
  EXPECT_NEAR(std::sqrt(p.variance_y + 0.36), g.sigma_side, 1e-12);
  const double volume = g.amplitude * g.sigma_rear * g.sigma_side;
  EXPECT_NEAR(225.0 * std::sqrt(p.variance_x * p.variance_y), volume, 1e-9);
  p.keep_amplitude = true;
  EXPECT_DOUBLE_EQ(225.0, gaussianOf(p, walking(0.0, 1.0, 0.6), walking(0.0, 1.0, 0.6), 0).amplitude);
}

TEST(PersonSpace, appliesTheTimeFactorsByLayer) {
  SocialParams p;
  p.amplitude_time_factor = -0.1;
  p.variance_time_factor = 0.2;
  p.forbidden_radius_time_factor = -0.05;
  p.keep_amplitude = true;
  const SweptGaussian g = gaussianOf(p, walking(0.0), walking(0.0), 3);
  EXPECT_NEAR(225.0 * 0.7, g.amplitude, 1e-9);
  EXPECT_NEAR(std::sqrt(p.variance_y * 1.6), g.sigma_side, 1e-12);
  EXPECT_NEAR(0.5 * 0.85, forbiddenRadius(p, 0.0, 3), 1e-12);
  EXPECT_EQ(0.0, forbiddenRadius(p, 0.0, 100)) << "never negative";
  EXPECT_EQ(0.0, gaussianOf(p, walking(0.0), walking(0.0), 100).amplitude);
}

TEST(PersonSpace, staysBelowTheInscribedCost) {
  SocialParams p;
  p.amplitude_multiplicator = 252.0;
  p.amplitude_time_factor = 1.0;
  EXPECT_EQ(252.0, gaussianOf(p, walking(0.0), walking(0.0), 9).amplitude);
}

TEST(PersonSpace, blocksNothingWhereNobodyIsSureToBe) {
  SocialParams p;
  p.forbidden_sigma_limit = 0.0;
  EXPECT_EQ(p.forbidden_radius, forbiddenRadius(p, 5.0, 0)) << "0: always block";
  p.forbidden_sigma_limit = 1.0;
  EXPECT_EQ(p.forbidden_radius, forbiddenRadius(p, 0.9, 0));
  EXPECT_EQ(0.0, forbiddenRadius(p, 1.1, 0));
}

TEST(SweptGaussian, isTheLargestCostOnTheWay) {
  const SocialParams p;
  const PersonState from{{0.0, 0.0}, 0.7, 1.0, 0.1};
  const PersonState to{{0.5 * std::cos(0.7), 0.5 * std::sin(0.7)}, 0.7, 1.0, 0.1};
  const SweptGaussian swept = gaussianOf(p, from, to, 0);
  for (const Eigen::Vector2d& point : {Eigen::Vector2d(0.2, 0.9), {1.2, 0.8}, {-0.6, -0.1}, {0.3, 0.1}}) {
    double largest = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      PersonState between = from;
      between.position = from.position + 0.001 * i * (to.position - from.position);
      largest = std::max(largest, costAt(gaussianOf(p, between, between, 0), point));
    }
    EXPECT_NEAR(largest, costAt(swept, point), 1e-3);
  }
}

}  // namespace
}  // namespace social_costmap
