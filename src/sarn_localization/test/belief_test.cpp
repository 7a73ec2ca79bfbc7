// SPDX-License-Identifier: BSD-3-Clause
// Motion, clusters of particles, noticing that one is lost.
#include <gtest/gtest.h>

#include <cmath>

#include "sarn_localization/motion_model.h"
#include "sarn_localization/pose_belief.h"
#include "sarn_localization/recovery_monitor.h"

namespace sarn_localization {
namespace {

constexpr MotionNoise kNoise{0.04, 0.01, 0.09, 0.02};

TEST(MotionBelief, isThatOfTheFormulaOnAStraightLine) {
  const PoseEstimate motion = motionBelief({2.0, 0.0, 0.0}, kNoise);
  EXPECT_NEAR(motion.covariance(0, 0), 0.09 * 4.0, 1e-12);        // along: alpha3 d^2
  EXPECT_NEAR(motion.covariance(1, 1), 4.0 * 0.01 * 4.0, 1e-12);  // across: d^2 var(rot1)
  EXPECT_NEAR(motion.covariance(2, 2), 2.0 * 0.01 * 4.0, 1e-12);  // heading: var(rot1) + var(rot2)
  EXPECT_NEAR(motion.covariance(1, 2), 2.0 * 0.01 * 4.0, 1e-12);
}

TEST(MotionBelief, isThatOfTheFormulaOnTheSpot) {
  const PoseEstimate motion = motionBelief({0.0, 0.0, 0.5}, kNoise);
  EXPECT_NEAR(motion.covariance(2, 2), 0.04 * 0.25, 1e-12);
  EXPECT_NEAR(motion.covariance(0, 0), 0.02 * 0.25, 1e-12);
}

TEST(MotionBelief, isAsCertainBackwardsAsForwards) {
  const Eigen::Matrix3d ahead = motionBelief({0.3, 0.02, 0.1}, kNoise).covariance;
  const Eigen::Matrix3d back = motionBelief({-0.3, 0.02, -0.1}, kNoise).covariance;
  EXPECT_TRUE(ahead.diagonal().isApprox(back.diagonal(), 1e-9));
}

TEST(MotionBelief, isCertainWithoutNoise) {
  EXPECT_TRUE(motionBelief({0.3, 0.1, 0.2}, {}).covariance.isZero());
}

TEST(HeaviestCluster, isTheHeavierOfTwo) {
  std::vector<WeightedPose> particles;
  for (int i = -5; i <= 5; ++i) {
    particles.push_back({{1.0 + 0.01 * i, 2.0, 0.0}, 1.0});
    particles.push_back({{5.0, 2.0 + 0.02 * i, sarn::kPi - 0.001 * i}, 2.0});
  }
  const PoseEstimate estimate = heaviestCluster(particles);
  EXPECT_NEAR(estimate.pose.x, 5.0, 1e-9);
  EXPECT_NEAR(estimate.pose.y, 2.0, 1e-9);
  EXPECT_NEAR(std::abs(estimate.pose.theta), sarn::kPi, 1e-6);  // a mean across the seam of the circle
  EXPECT_NEAR(estimate.covariance(1, 1), 0.02 * 0.02 * 10.0, 1e-9);
  EXPECT_NEAR(estimate.covariance(0, 0), 0.0, 1e-12);
}

TEST(HeaviestCluster, turnsWithTheWorld) {
  std::vector<WeightedPose> particles, turned;
  const sarn::Pose2D world{3.0, -1.0, 1.1};
  for (int i = 0; i < 50; ++i) {
    const sarn::Pose2D pose{1.2 + 0.02 * std::sin(7.0 * i), 0.8 + 0.03 * std::cos(5.0 * i),
                            0.4 + 0.01 * std::sin(3.0 * i)};
    particles.push_back({pose, 1.0 + 0.01 * i});
    turned.push_back({world * pose, 1.0 + 0.01 * i});
  }
  const sarn::Pose2D expected = world * heaviestCluster(particles).pose;
  const sarn::Pose2D found = heaviestCluster(turned).pose;
  EXPECT_NEAR(found.x, expected.x, 1e-6);
  EXPECT_NEAR(found.y, expected.y, 1e-6);
  EXPECT_NEAR(found.theta, expected.theta, 1e-6);
}

TEST(RecoveryMonitor, addsNothingWhileTheMapExplainsTheScans) {
  RecoveryMonitor monitor(0.001, 0.1);
  for (int i = 0; i < 1000; ++i) EXPECT_DOUBLE_EQ(monitor.add(0.9), 0.0);
}

TEST(RecoveryMonitor, addsParticlesAfterAFallAndStopsWhenItIsOver) {
  RecoveryMonitor monitor(0.001, 0.1);
  for (int i = 0; i < 1000; ++i) static_cast<void>(monitor.add(0.9));
  double share = 0.0;
  for (int i = 0; i < 10; ++i) share = monitor.add(0.2);
  EXPECT_NEAR(share, 1.0 - monitor.fast() / monitor.slow(), 1e-12);
  EXPECT_GT(share, 0.3);
  for (int i = 0; i < 60; ++i) share = monitor.add(0.9);
  EXPECT_LT(share, 0.01);
}

TEST(RecoveryMonitor, noticesAWrongStart) {
  RecoveryMonitor monitor(0.001, 0.1);
  double share = 0.0;
  for (int i = 0; i < 20; ++i) share = monitor.add(0.2);
  EXPECT_GT(share, 0.4);
}

TEST(RecoveryMonitor, canBeSwitchedOff) {
  RecoveryMonitor monitor(0.0, 0.0);
  for (int i = 0; i < 100; ++i) EXPECT_DOUBLE_EQ(monitor.add(0.0), 0.0);
}

}  // namespace
}  // namespace sarn_localization
