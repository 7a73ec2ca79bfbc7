// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/timed_trajectory.h"

#include <gtest/gtest.h>

namespace sarn {
namespace {

TEST(TimedTrajectory, samplesTheArcOfMeanSpeeds) {
  TimedTrajectory trajectory;
  trajectory.points = {{0, 0, 0, 0.0, 0.0, 10.0}, {0.25, 0, 0, 0.5, 0.0, 11.0}, {0.75, 0, 0, 0.5, 0.0, 12.0}};
  EXPECT_DOUBLE_EQ(trajectory.sample(9.0).x, 0.0);
  EXPECT_DOUBLE_EQ(trajectory.sample(10.5).x, 0.125);
  EXPECT_DOUBLE_EQ(trajectory.sample(10.5).v, 0.25);
  EXPECT_DOUBLE_EQ(trajectory.sample(11.5).x, 0.5);
  EXPECT_DOUBLE_EQ(trajectory.sample(12.0).x, 0.75);
  EXPECT_DOUBLE_EQ(trajectory.sample(20.0).x, 0.75);
  EXPECT_DOUBLE_EQ(trajectory.sample(20.0).v, 0.0);
  EXPECT_DOUBLE_EQ(trajectory.length(), 0.75);
}

TEST(TimedTrajectory, headingCrossesTheSeamTheShortWay) {
  TimedTrajectory trajectory;
  trajectory.points = {{0, 0, kPi - 0.1, 0.0, 0.2, 0.0}, {0, 0, -kPi + 0.1, 0.0, 0.2, 1.0}};
  EXPECT_NEAR(trajectory.sample(0.75).theta, -kPi + 0.05, 1e-12);
}

}  // namespace
}  // namespace sarn
