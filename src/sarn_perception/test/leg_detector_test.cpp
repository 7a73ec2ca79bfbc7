// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/leg_detector.h"

#include <gtest/gtest.h>

#include "small_world.h"

namespace sarn_perception {
namespace {

class LegDetectorTest : public ::testing::Test {
 protected:
  LegDetectorTest() { background_.setMap(room()); }

  [[nodiscard]] std::vector<Leg> legs(const sarn::Pose2D& sensor, const std::vector<Disc>& discs,
                                      int beams = 720, double field_of_view = 2.0 * sarn::kPi) const {
    return detector_.detect(scanOf(sensor, discs, beams, field_of_view), background_, sensor).legs;
  }

  Background background_{{}};
  LegDetector detector_{{}};
  sarn::Pose2D sensor_{2.0, 3.0, 0.0};
};

TEST_F(LegDetectorTest, findsNobodyInAnEmptyRoom) {
  for (int i = 0; i < 36; ++i) {
    EXPECT_TRUE(legs({1.0 + 0.1 * i, 2.0 + 0.05 * i, 0.2 * i}, {}).empty()) << i;
  }
}

TEST_F(LegDetectorTest, findsBothLegsWhereTheyAre) {
  const auto discs = legsAt({4.0, 3.0});
  const auto found = legs(sensor_, discs);
  ASSERT_EQ(found.size(), 2U);
  const Eigen::Vector2d middle = 0.5 * (found[0].position + found[1].position);
  EXPECT_NEAR((sensor_ * middle - Eigen::Vector2d(4.0, 3.0)).norm(), 0.0, 0.03);
  for (const Leg& leg : found) EXPECT_GT(leg.confidence, 0.6);
}

TEST_F(LegDetectorTest, worksWithAnyNumberOfBeamsAndView) {
  for (const int beams : {360, 541, 1080, 1440}) {
    EXPECT_EQ(legs(sensor_, legsAt({3.5, 3.0}), beams).size(), 2U) << beams;
  }
  EXPECT_EQ(legs(sensor_, legsAt({3.5, 3.0}), 640, 1.02).size(), 2U);
}

TEST_F(LegDetectorTest, holdsAcrossTheSeamOfAFullTurn) {
  // The leg lies behind the sensor, where the scan begins and ends.
  EXPECT_EQ(legs({4.0, 3.0, 0.0}, {{{2.5, 3.0}, 0.056}}).size(), 1U);
}

TEST_F(LegDetectorTest, dividesTwoLegsThatStandTogether) {
  const auto found = legs(sensor_, {{{4.0, 3.07}, 0.06}, {{4.0, 2.93}, 0.06}});
  EXPECT_EQ(found.size(), 2U);
}

/// A leg torn in two passed for both legs of its person, and moved them by 0.15 m from one scan to the next.
TEST_F(LegDetectorTest, takesATornLegForOne) {
  PlanarScan scan = scanOf(sensor_, {{{4.0, 3.0}, 0.056}}, 640, 1.02);
  std::fill(scan.ranges.begin() + 318, scan.ranges.begin() + 323, std::nanf(""));
  const auto found = detector_.detect(scan, background_, sensor_).legs;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR((sensor_ * found[0].position - Eigen::Vector2d(4.0, 3.0)).norm(), 0.0, 0.02);
}

TEST_F(LegDetectorTest, refusesWhatIsWiderThanAPerson) {
  EXPECT_TRUE(legs(sensor_, {{{4.0, 3.0}, 0.6}}).empty()) << "a pillar of 1.2 m";
}

TEST_F(LegDetectorTest, takesTheLocalisationsErrorAndAWallBehind) {
  const sarn::Pose2D truth{2.0, 3.0, 0.0};
  const auto scan = scanOf(truth, legsAt({5.35, 3.0}));  // 0.45 m from the wall
  const sarn::Pose2D wrong{2.05, 2.95, 0.03};
  EXPECT_EQ(detector_.detect(scan, background_, wrong).legs.size(), 2U);
  const auto empty = scanOf(truth, {});
  EXPECT_TRUE(detector_.detect(empty, background_, wrong).legs.empty());
}

TEST_F(LegDetectorTest, isTheSameForASensorThatTurnsTheOtherWay) {
  PlanarScan scan = scanOf(sensor_, legsAt({4.0, 3.4}));
  const auto found = detector_.detect(scan, background_, sensor_).legs;
  std::reverse(scan.ranges.begin(), scan.ranges.end());
  std::swap(scan.angle_min, scan.angle_max);
  scan.angle_increment = -scan.angle_increment;
  const auto mirrored = detector_.detect(scan, background_, sensor_).legs;
  ASSERT_EQ(found.size(), mirrored.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR((found[i].position - mirrored[i].position).norm(), 0.0, 1e-4);
  }
}

TEST_F(LegDetectorTest, takesHolesInTheScan) {
  PlanarScan scan = scanOf(sensor_, legsAt({4.0, 3.0}));
  for (std::size_t i = 0; i < scan.ranges.size(); i += 7) scan.ranges[i] = std::nanf("");
  for (std::size_t i = 3; i < scan.ranges.size(); i += 41) {
    scan.ranges[i] = std::numeric_limits<float>::infinity();
  }
  for (std::size_t i = 5; i < scan.ranges.size(); i += 43) {
    scan.ranges[i] = -std::numeric_limits<float>::infinity();
  }
  const auto found = detector_.detect(scan, background_, sensor_).legs;
  ASSERT_GE(found.size(), 1U);
  for (const Leg& leg : found) EXPECT_TRUE(leg.position.allFinite());
}

TEST_F(LegDetectorTest, refusesScansThatMakeNoSense) {
  const PlanarScan good = scanOf(sensor_, {});
  const auto refused = [&](auto&& spoil) {
    PlanarScan scan = good;
    spoil(scan);
    EXPECT_THROW((void)detector_.detect(scan, background_, sensor_), ScanError);
  };
  refused([](PlanarScan& scan) { scan.ranges.clear(); });
  refused([](PlanarScan& scan) { scan.angle_increment = 0.0F; });
  refused([](PlanarScan& scan) { scan.angle_increment = std::nanf(""); });
  refused([](PlanarScan& scan) { scan.angle_min = std::numeric_limits<float>::infinity(); });
  refused([](PlanarScan& scan) { scan.range_max = std::nanf(""); });
  refused([](PlanarScan& scan) { scan.angle_increment *= 2.0F; });
  PlanarScan nothing = good;
  std::fill(nothing.ranges.begin(), nothing.ranges.end(), std::nanf(""));
  EXPECT_TRUE(detector_.detect(nothing, background_, sensor_).legs.empty());
}

}  // namespace
}  // namespace sarn_perception
