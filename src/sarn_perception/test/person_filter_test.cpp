// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/person_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace sarn_perception {
namespace {

TEST(PersonFilter, growsAsTheModelOfWhiteAcceleration) {
  PersonFilter filter({1.0, 2.0}, 0.1, 0.5);
  const double dt = 2.0;
  const double q = 0.3;
  filter.predict(dt, q);
  EXPECT_NEAR(filter.covariance()(0, 0), 0.01 + 0.25 * dt * dt + q * dt * dt * dt / 3.0, 1e-12);
  EXPECT_NEAR(filter.covariance()(0, 2), 0.25 * dt + q * dt * dt / 2.0, 1e-12);
  EXPECT_NEAR(filter.covariance()(3, 3), 0.25 + q * dt, 1e-12);
  EXPECT_DOUBLE_EQ(filter.covariance()(0, 1), 0.0);
}

TEST(PersonFilter, weighsAMeasurementByItsVariance) {
  PersonFilter filter({0.0, 0.0}, 1.0, 0.0);
  filter.update({2.0, 0.0}, 1.0, 0.0);  // as certain as the filter: half-way
  EXPECT_NEAR(filter.position().x(), 1.0, 1e-12);
  EXPECT_NEAR(filter.covariance()(0, 0), 0.5, 1e-12);
}

TEST(PersonFilter, learnsTheVelocity) {
  PersonFilter filter({0.0, 0.0}, 0.05, 0.8);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (int i = 1; i <= 60; ++i) {
    const double t = i / 30.0;
    filter.predict(1.0 / 30.0, 0.1);
    filter.update({0.9 * t + noise(random), -0.4 * t + noise(random)}, 0.05, 0.0);
  }
  EXPECT_NEAR(filter.velocity().x(), 0.9, 0.1);
  EXPECT_NEAR(filter.velocity().y(), -0.4, 0.1);
}

TEST(PersonFilter, takesALateMeasurementAtItsTime) {
  PersonFilter filter({0.0, 0.0}, 0.01, 1.0);
  for (int i = 1; i <= 50; ++i) {
    filter.predict(0.1, 0.01);
    filter.update({0.1 * i, 0.0}, 0.02, 0.0);  // 1 m/s
  }
  const Eigen::Vector2d before = filter.position();
  filter.update({before.x() - 0.2, 0.0}, 0.02, 0.2);  // where the person was 0.2 s ago: no surprise
  EXPECT_NEAR(filter.position().x(), before.x(), 5e-3);
  PersonFilter naive = filter;
  naive.update({before.x() - 0.2, 0.0}, 0.02, 0.0);
  EXPECT_LT(naive.position().x(), before.x() - 0.02) << "as a present one it would pull back";
}

/// The legs of somebody who walks along x at 1 m/s, at a time [s]: 0.09 m to each side, swinging by 0.3 m.
std::vector<Leg> legsOfAWalker(double time) {
  const double swing = 0.3 * std::sin(5.0 * time);
  return {{{time + swing, 0.09}, 0.01}, {{time - swing, -0.09}, 0.01}};
}

TEST(PersonFilter, twoLegsTellTheMiddleAndTheOffset) {
  PersonFilter filter({0.3, 0.3}, 0.5, 0.6);
  filter.update(legsAt({{{1.0, 0.1}, 0.01}, {{1.2, -0.1}, 0.01}}, 1.0, 0.0));
  EXPECT_NEAR((filter.position() - Eigen::Vector2d(1.1, 0.0)).norm(), 0.0, 1e-3);
  EXPECT_NEAR((filter.legOffset() - Eigen::Vector2d(-0.1, 0.1)).norm(), 0.0, 5e-3);
  EXPECT_NEAR(filter.positionSigma(), 0.01 / std::sqrt(2.0), 1e-3);
}

TEST(PersonFilter, oneLegTellsTheMiddleNoBetterThanTheStance) {
  PersonFilter filter({0.0, 0.0}, 0.5, 0.6);
  filter.update(legsAt({{{0.0, 0.0}, 0.01}}, 1.0, 0.0));
  EXPECT_NEAR(filter.positionSigma(), GaitModel{}.stance_sigma, 0.01);
}

/// The far leg disappears behind the near one for 0.2 s, which swings at up to 2.5 m/s meanwhile.
TEST(PersonFilter, aSwingingLegDoesNotPassForAPerson) {
  PersonFilter filter({0.0, 0.0}, 0.5, 0.6);
  PersonFilter naive = filter;
  double error = 0.0;
  double naive_error = 0.0;
  for (int i = 1; i <= 90; ++i) {
    const double time = i / 30.0;
    std::vector<Leg> legs = legsOfAWalker(time);
    const bool hidden = i > 80 && i % 30 < 27;
    if (hidden) legs.pop_back();
    filter.predict(1.0 / 30.0, 0.1);
    filter.update(legsAt(legs, 1.0, 0.0));
    naive.predict(1.0 / 30.0, 0.1);
    naive.update(0.5 * (legs.front().position + legs.back().position), 0.01, 0.0);
    if (!hidden) continue;
    error = std::max(error, std::abs(filter.velocity().x() - 1.0));
    naive_error = std::max(naive_error, std::abs(naive.velocity().x() - 1.0));
  }
  EXPECT_LT(error, 0.2);
  EXPECT_GT(naive_error, 2.0 * error);
}

TEST(PersonFilter, forgetsTheOffsetOfLegsAndSpreadsItAlongTheWay) {
  PersonFilter filter({0.0, 0.0}, 0.01, 0.0);
  for (int i = 1; i <= 60; ++i) {
    filter.predict(1.0 / 30.0, 0.1);
    filter.update(legsAt(legsOfAWalker(i / 30.0), 1.0, 0.0));
  }
  const GaitModel gait;
  filter.predict(10.0 * gait.settle_time, 1e-6);
  const Eigen::Matrix2d spread = filter.fullCovariance().bottomRightCorner<2, 2>();
  EXPECT_LT(filter.legOffset().norm(), 1e-3);
  EXPECT_NEAR(std::sqrt(spread(0, 0)), gait.stance_sigma + gait.swing_time * filter.velocity().norm(), 5e-3);
  EXPECT_NEAR(std::sqrt(spread(1, 1)), gait.stance_sigma, 5e-3);
}

TEST(PersonFilter, staysPositive) {
  PersonFilter filter({0.0, 0.0}, 0.1, 1.0);
  for (int i = 0; i < 1000; ++i) {
    filter.predict(1e-3, 1e-6);
    filter.update({0.0, 0.0}, 1e-3, i % 2 == 0 ? 0.0 : 0.2);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(filter.covariance());
  EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0);
  EXPECT_LT(filter.positionSigma(), 1e-3);
}

TEST(PersonFilter, isNeverFasterThanPeopleAre) {
  GaitModel gait;
  gait.max_speed = 2.0;
  PersonFilter filter({0.0, 0.0}, 0.05, 5.0, gait);
  filter.predict(0.1, 15.0);
  filter.update({0.6, 0.8}, 0.01, 0.0);  // 10 m/s
  filter.limitSpeed();
  EXPECT_NEAR(filter.velocity().x(), 1.2, 0.05);
  EXPECT_NEAR(filter.velocity().y(), 1.6, 0.05);
  const Eigen::Vector2d before = filter.velocity();
  filter.limitSpeed();
  EXPECT_NEAR((filter.velocity() - before).norm(), 0.0, 1e-12) << "only what is too fast";
}

}  // namespace
}  // namespace sarn_perception
