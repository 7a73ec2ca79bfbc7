// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/person_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
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

}  // namespace
}  // namespace sarn_perception
