// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/swept_corridor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sarn_common/angles.h"

namespace sarn_navigation {
namespace {

constexpr double kRadius = 0.2;  // [m]

/// The definition, stepped: path length at which the disc's centre comes within the radius of the point.
double steppedFreeDistance(const sarn::Twist2D& twist, const Eigen::Vector2d& point, double max_length) {
  const double step = 1e-4;  // [m]
  for (double length = 0.0; length < max_length; length += step) {
    const sarn::Pose2D pose = sarn::advance({}, twist, length / std::abs(twist.v));
    if ((pose.position() - point).norm() <= kRadius) return length;
  }
  return max_length;
}

TEST(StoppingDistance, isReactionPlusBraking) {
  EXPECT_DOUBLE_EQ(stoppingDistance(0.5, 0.2, 1.0), 0.5 * 0.2 + 0.125);
  EXPECT_DOUBLE_EQ(stoppingDistance(-0.5, 0.2, 1.0), stoppingDistance(0.5, 0.2, 1.0));
  EXPECT_DOUBLE_EQ(stoppingDistance(0.0, 0.2, 1.0), 0.0);
}

TEST(StoppingDistance, hasAnInverse) {
  for (double v = 0.0; v < 1.0; v += 0.1) {
    EXPECT_NEAR(speedThatStopsWithin(stoppingDistance(v, 0.3, 0.7), 0.3, 0.7), v, 1e-12);
  }
  EXPECT_DOUBLE_EQ(speedThatStopsWithin(-1.0, 0.3, 0.7), 0.0);
}

TEST(FreeDistance, aheadOfAStraightLine) {
  EXPECT_DOUBLE_EQ(freeDistance({0.5, 0.0}, {1.0, 0.0}, kRadius), 0.8);
  EXPECT_NEAR(freeDistance({0.5, 0.0}, {1.0, 0.12}, kRadius), 1.0 - 0.16, 1e-12);
  EXPECT_TRUE(std::isinf(freeDistance({0.5, 0.0}, {1.0, 0.21}, kRadius)));
  EXPECT_TRUE(std::isinf(freeDistance({0.5, 0.0}, {-1.0, 0.0}, kRadius)));
  EXPECT_DOUBLE_EQ(freeDistance({-0.5, 0.0}, {-1.0, 0.0}, kRadius), 0.8);
}

TEST(FreeDistance, turningInPlaceSweepsNothing) {
  EXPECT_TRUE(std::isinf(freeDistance({0.0, 2.0}, {0.21, 0.0}, kRadius)));
}

TEST(FreeDistance, agreesWithTheSteppedArc) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> speed(-0.8, 0.8);
  std::uniform_real_distribution<double> turn(-2.0, 2.0);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  int touched = 0;
  for (int i = 0; i < 900; ++i) {
    const sarn::Twist2D twist{speed(random), turn(random)};
    const Eigen::Vector2d point(place(random), place(random));
    if (std::abs(twist.v) < 0.05 || point.norm() < 0.25) continue;
    const double circumference = 2.0 * sarn::kPi * std::abs(twist.v / twist.omega);
    const double length = std::min(3.0, circumference);
    const double expected = steppedFreeDistance(twist, point, length);
    const double actual = std::min(length, freeDistance(twist, point, kRadius));
    EXPECT_NEAR(actual, expected, 2e-2) << twist.v << " " << twist.omega << " " << point.transpose();
    touched += expected < length ? 1 : 0;
  }
  EXPECT_GT(touched, 50);
}

TEST(FreeDistance, mirrorsLeftAndRightForwardAndBackward) {
  const Eigen::Vector2d p(0.6, 0.3);
  const double reference = freeDistance({0.4, 0.8}, p, kRadius);
  EXPECT_TRUE(std::isfinite(reference));
  EXPECT_NEAR(freeDistance({0.4, -0.8}, {0.6, -0.3}, kRadius), reference, 1e-12);
  EXPECT_NEAR(freeDistance({-0.4, -0.8}, {-0.6, 0.3}, kRadius), reference, 1e-12);
  EXPECT_NEAR(freeDistance({-0.4, 0.8}, {-0.6, -0.3}, kRadius), reference, 1e-12);
}

TEST(FreeDistance, aVeryWideArcIsAStraightLine) {
  EXPECT_NEAR(freeDistance({0.5, 1e-4}, {1.0, 0.1}, kRadius), freeDistance({0.5, 0.0}, {1.0, 0.1}, kRadius),
              1e-3);
}

TEST(FreeDistance, aTouchedPointBlocksOnlyTheWayTowardsIt) {
  EXPECT_LT(freeDistance({0.5, 0.0}, {0.19, 0.0}, kRadius), 0.02);
  EXPECT_TRUE(std::isinf(freeDistance({-0.5, 0.0}, {0.19, 0.0}, kRadius)));
  EXPECT_TRUE(std::isinf(freeDistance({0.5, 0.0}, {0.0, 0.19}, kRadius)));
  EXPECT_GT(freeDistance({0.5, -1.0}, {0.0, 0.19}, kRadius), 1.0);  // turns away from it
}

}  // namespace
}  // namespace sarn_navigation
