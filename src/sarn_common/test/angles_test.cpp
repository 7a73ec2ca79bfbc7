// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/angles.h"

#include <gtest/gtest.h>

#include "sarn_common/pose2d.h"

namespace sarn {
namespace {

TEST(WrapAngle, mapsIntoHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrapAngle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrapAngle(-kPi), kPi);
  EXPECT_NEAR(wrapAngle(3.0 * kPi), kPi, 1e-12);
  EXPECT_NEAR(wrapAngle(kPi + 0.1), -kPi + 0.1, 1e-12);
  for (double angle = -20.0; angle < 20.0; angle += 0.37) {
    const double wrapped = wrapAngle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
  }
}

TEST(AngleDifference, takesTheShortWay) {
  EXPECT_NEAR(angleDifference(kPi - 0.1, -kPi + 0.1), 0.2, 1e-12);
  EXPECT_NEAR(angleDifference(-kPi + 0.1, kPi - 0.1), -0.2, 1e-12);
}

TEST(Pose2D, composesWithItsInverseToIdentity) {
  const Pose2D pose{1.5, -2.0, 2.5};
  const Pose2D identity = pose * inverse(pose);
  EXPECT_NEAR(identity.x, 0.0, 1e-12);
  EXPECT_NEAR(identity.y, 0.0, 1e-12);
  EXPECT_NEAR(identity.theta, 0.0, 1e-12);
  const Eigen::Vector2d p = Pose2D{1.0, 2.0, kPi / 2} * Eigen::Vector2d(3.0, 0.0);
  EXPECT_NEAR(p.x(), 1.0, 1e-12);
  EXPECT_NEAR(p.y(), 5.0, 1e-12);
}

TEST(Advance, followsTheArcAndIsContinuousAtZeroTurn) {
  const Pose2D quarter = advance({0.0, 0.0, 0.0}, {1.0, 1.0}, kPi / 2);  // unit circle about (0, 1)
  EXPECT_NEAR(quarter.x, 1.0, 1e-12);
  EXPECT_NEAR(quarter.y, 1.0, 1e-12);
  EXPECT_NEAR(quarter.theta, kPi / 2, 1e-12);
  const Pose2D straight = advance({0.0, 0.0, 0.3}, {1.0, 0.0}, 2.0);
  const Pose2D nearly = advance({0.0, 0.0, 0.3}, {1.0, 1e-7}, 2.0);
  EXPECT_NEAR(straight.x, nearly.x, 1e-6);
  EXPECT_NEAR(straight.y, nearly.y, 1e-6);
  const Pose2D back = advance(quarter, {-1.0, -1.0}, kPi / 2);
  EXPECT_NEAR(back.x, 0.0, 1e-12);
  EXPECT_NEAR(back.y, 0.0, 1e-12);
}

}  // namespace
}  // namespace sarn
