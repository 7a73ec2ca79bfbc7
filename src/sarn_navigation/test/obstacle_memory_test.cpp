// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/obstacle_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sarn_common/angles.h"

namespace sarn_navigation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// 61 beams over +-0.5 rad, all of one range; 0.45 to 10 m as an Xtion.
Scan scanOf(double range) { return {-0.5, 1.0 / 60.0, 0.45, 10.0, std::vector<double>(61, range)}; }

/// The same with one post of 5 beams around the middle.
Scan postAt(double range, double background) {
  Scan scan = scanOf(background);
  for (std::size_t i = 28; i <= 32; ++i) scan.ranges[i] = range;
  return scan;
}

TEST(InterpretBeam, followsRep117) {
  EXPECT_EQ(interpretBeam(kNan, 0.45, 10.0).kind, BeamKind::kUnknown);
  EXPECT_EQ(interpretBeam(0.0, 0.0, 10.0).kind, BeamKind::kUnknown);
  EXPECT_EQ(interpretBeam(0.44, 0.45, 10.0).kind, BeamKind::kUnknown);
  EXPECT_EQ(interpretBeam(kInf, 0.45, 10.0).kind, BeamKind::kFree);
  EXPECT_EQ(interpretBeam(10.5, 0.45, 10.0).kind, BeamKind::kFree);
  EXPECT_EQ(interpretBeam(-kInf, 0.45, 10.0).kind, BeamKind::kHit);
  EXPECT_DOUBLE_EQ(interpretBeam(-kInf, 0.45, 10.0).range, 0.45);
  EXPECT_EQ(interpretBeam(3.0, 0.45, 10.0).kind, BeamKind::kHit);
}

TEST(ObstacleMemory, placesReturnsInTheRobotsFrame) {
  ObstacleMemory memory({});
  memory.insert(postAt(1.0, kInf), {5.0, 3.0, sarn::kPi / 2.0}, 1.0);
  const auto points = memory.pointsAround({5.0, 3.5, sarn::kPi / 2.0});
  ASSERT_FALSE(points.empty());
  for (const auto& p : points) {
    EXPECT_NEAR(p.x(), 0.5, 0.01);
    EXPECT_LT(std::abs(p.y()), 0.05);
  }
}

TEST(ObstacleMemory, nanAndInfLeaveNothing) {
  ObstacleMemory memory({});
  for (const double range : {kNan, kInf, 0.0, 11.0, -1.0}) memory.insert(scanOf(range), {}, 1.0);
  EXPECT_EQ(memory.size(), 0U);
}

TEST(ObstacleMemory, remembersWhatLeftTheViewForTheMemoryTime) {
  ObstacleMemory memory({2.0, 10.0, 3.0});
  memory.insert(postAt(1.0, kInf), {}, 1.0);
  const sarn::Pose2D turned{0.0, 0.0, 1.5};
  memory.insert(scanOf(kInf), turned, 2.9);
  EXPECT_GT(memory.size(), 0U);
  memory.insert(scanOf(kInf), turned, 3.1);
  EXPECT_EQ(memory.size(), 0U);
}

TEST(ObstacleMemory, forgetsAtOnceWhatABeamLooksThrough) {
  for (const double background : {3.0, kInf}) {
    ObstacleMemory memory({2.0, 10.0, 2.0});
    memory.insert(postAt(1.0, kNan), {}, 1.0);
    EXPECT_GT(memory.size(), 0U);
    memory.insert(scanOf(background), {}, 1.03);
    EXPECT_EQ(memory.size(), 0U) << background;
  }
}

TEST(ObstacleMemory, nanProvesNothingAtOnce) {
  ObstacleMemory memory({2.0, 10.0, 2.0, 0.6});
  memory.insert(postAt(1.0, kNan), {}, 1.0);
  memory.insert(scanOf(kNan), {}, 1.55);
  EXPECT_GT(memory.size(), 0U) << "black trousers may return nothing for a moment";
}

TEST(ObstacleMemory, forgetsWhoPassedWhereThereIsNothingBehind) {
  ObstacleMemory memory({2.0, 10.0, 2.0, 0.6});
  memory.insert(postAt(1.0, kNan), {}, 1.0);
  memory.insert(scanOf(kNan), {}, 1.65);
  EXPECT_EQ(memory.size(), 0U);
}

TEST(ObstacleMemory, silenceSaysNothingOfWhatIsTooNearToBeSeen) {
  ObstacleMemory memory({2.0, 10.0, 2.0, 0.6});
  memory.insert(postAt(0.5, kNan), {}, 1.0);
  memory.insert(scanOf(kNan), {}, 1.65);
  EXPECT_GT(memory.size(), 0U);
}

TEST(ObstacleMemory, keepsWhatIsTooNearToBeSeenForTheNearMemoryTime) {
  ObstacleMemory memory({2.0, 10.0, 2.0});
  memory.insert(postAt(0.5, kInf), {}, 1.0);
  const sarn::Pose2D closer{0.2, 0.0, 0.0};
  for (double t = 1.1; t < 10.9; t += 0.1) memory.insert(scanOf(kNan), closer, t);
  EXPECT_GT(memory.size(), 0U);
  for (double t = 10.9; t < 11.2; t += 0.1) memory.insert(scanOf(kNan), closer, t);
  EXPECT_EQ(memory.size(), 0U);
}

TEST(ObstacleMemory, whatWasTooNearIsStillRememberedAfterTurningAway) {
  ObstacleMemory memory({2.0, 10.0, 2.0});
  memory.insert(postAt(0.5, kInf), {}, 1.0);
  for (double t = 1.1; t < 5.0; t += 0.1) memory.insert(scanOf(kNan), {0.2, 0.0, 0.0}, t);
  memory.insert(scanOf(kInf), {0.2, 0.0, 1.5}, 6.0);
  EXPECT_GT(memory.size(), 0U);
}

TEST(ObstacleMemory, forgetsWhatIsFarAway) {
  ObstacleMemory memory({100.0, 100.0, 2.0});
  memory.insert(postAt(1.0, kInf), {}, 1.0);
  memory.insert(scanOf(kInf), {0.0, 2.5, 1.5}, 1.1);
  EXPECT_EQ(memory.size(), 0U);
}

TEST(ObstacleMemory, staysSmallInAStandingRobot) {
  ObstacleMemory memory({2.0, 10.0, 2.0});
  memory.insert(scanOf(1.0), {}, 1.0);
  const std::size_t once = memory.size();
  for (int i = 0; i < 100; ++i) memory.insert(scanOf(1.0), {}, 1.0 + 0.03 * i);
  EXPECT_EQ(memory.size(), once);
}

}  // namespace
}  // namespace sarn_navigation
