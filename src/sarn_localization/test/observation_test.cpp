// SPDX-License-Identifier: BSD-3-Clause
// Beams, distances to walls, the likelihood of a scan, people in a scan.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "drawn_map.h"
#include "sarn_localization/distance_filter.h"
#include "sarn_localization/likely_poses.h"
#include "sarn_localization/recent_scans.h"
#include "sarn_localization/scan_likelihood.h"

namespace sarn_localization {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(SelectBeams, leavesOutWhatIsNotARangeWithinLimits) {
  const PlanarScan scan{0.0, 0.1, 0.5, 8.0, {kNan, 1.0F, kInf, -kInf, 0.4F, 9.0F, 2.0F, 7.0F}};
  const ScanBeams beams = selectBeams(scan, {}, {10, 0.0, 6.0, 0.0});
  ASSERT_EQ(beams.beams.size(), 2U);
  EXPECT_DOUBLE_EQ(beams.beams[0].range, 1.0);
  EXPECT_DOUBLE_EQ(beams.beams[1].range, 2.0);
}

TEST(SelectBeams, placesEndsInBaseAndTakesTheBiasOff) {
  const PlanarScan scan{0.5 * sarn::kPi, 0.1, 0.1, 8.0, {2.0F}};
  const ScanBeams beams = selectBeams(scan, {1.0, 0.5, 0.5 * sarn::kPi}, {10, 0.0, 6.0, 0.1});
  ASSERT_EQ(beams.beams.size(), 1U);
  EXPECT_NEAR(beams.beams[0].end.x(), 1.0 - 2.4, 1e-9);
  EXPECT_NEAR(beams.beams[0].end.y(), 0.5, 1e-9);
}

TEST(SelectBeams, turnsBeamsByTheirOffset) {
  const PlanarScan scan{0.2, 0.1, 0.1, 8.0, {2.0F}};
  const ScanBeams beams = selectBeams(scan, {}, {10, 0.0, 6.0, 0.0, 0.5});
  ASSERT_EQ(beams.beams.size(), 1U);
  EXPECT_NEAR(std::atan2(beams.beams[0].end.y(), beams.beams[0].end.x()), 0.25, 1e-9);
}

TEST(SelectBeams, spreadsTheChoiceOverTheScan) {
  PlanarScan scan{0.0, 0.01, 0.1, 8.0, std::vector<float>(100, 1.0F)};
  const ScanBeams beams = selectBeams(scan, {}, {4, 0.0, 6.0, 0.0});
  ASSERT_EQ(beams.beams.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const double angle = std::atan2(beams.beams[k].direction.y(), beams.beams[k].direction.x());
    EXPECT_NEAR(angle, 0.12 + 0.25 * static_cast<double>(k), 0.011);
  }
}

TEST(SelectBeams, givesNothingForAScanOfNothing) {
  EXPECT_TRUE(selectBeams({0.0, 0.1, 0.1, 8.0, {}}, {}, {}).beams.empty());
  EXPECT_TRUE(selectBeams({0.0, 0.1, 0.1, 8.0, {kNan, kInf}}, {}, {}).beams.empty());
  EXPECT_TRUE(selectBeams({std::nan(""), 0.1, 0.1, 8.0, {1.0F}}, {}, {}).beams.empty());
}

TEST(WallDistance, isZeroOnTheSurfaceAndGrowsToBothSides) {
  const WallDistance walls(
      drawnMap({"..........", "..........", "....##....", "....##....", "..........", ".........."}, 0.1));
  // The block's left surface lies at x = 0.4; a row through its middle cells.
  EXPECT_NEAR(walls.at({0.40, 0.25}, 1.0), 0.0, 1e-6);
  EXPECT_NEAR(walls.at({0.25, 0.25}, 1.0), 0.15, 1e-6);
  EXPECT_NEAR(walls.at({0.45, 0.25}, 1.0), 0.05, 1e-6);
  EXPECT_DOUBLE_EQ(walls.at({-5.0, 0.25}, 1.0), 1.0);
  EXPECT_TRUE(walls.open({0.25, 0.25}));
  EXPECT_FALSE(walls.open({0.45, 0.25}));
  EXPECT_FALSE(walls.open({-0.1, 0.25}));
}

TEST(WallDistance, castsRaysOntoSurfaces) {
  const WallDistance walls(unevenRoom());
  EXPECT_NEAR(walls.castRay({4.0, 3.0}, {-1.0, 0.0}, 20.0), 3.9, 0.01);
  EXPECT_NEAR(walls.castRay({4.0, 3.0}, {0.0, -1.0}, 20.0), 2.9, 0.01);
  EXPECT_DOUBLE_EQ(walls.castRay({4.0, 3.0}, {-1.0, 0.0}, 2.0), 2.0);
}

TEST(WallDistance, refusesAMapWithoutWallsOrWithoutFloor) {
  EXPECT_THROW(WallDistance(drawnMap({"....", "...."}, 0.1)), std::invalid_argument);
  EXPECT_THROW(WallDistance(drawnMap({"##??", "####"}, 0.1)), std::invalid_argument);
}

TEST(WallDistance, doesNotDependOnTheResolution) {
  const WallDistance fine(unevenRoom());
  sarn::OccupancyMap half({80, 60, 0.1, 0.0, 0.0}, sarn::kMapFree);
  const sarn::OccupancyMap room = unevenRoom();
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) half.at({x, y}) = room.at({2 * x, 2 * y});
  }
  const WallDistance coarse(half);
  for (const double angle : {0.3, 1.9, 3.3, 5.0}) {
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    EXPECT_NEAR(fine.castRay({4.0, 3.0}, direction, 20.0), coarse.castRay({4.0, 3.0}, direction, 20.0), 0.05);
  }
}

TEST(ScanLikelihood, isThatOfTheFormulaForOneBeam) {
  LocalizationParams params;
  params.laser_sigma_hit = 0.1;
  params.laser_sigma_range = 0.05;
  const WallDistance walls(unevenRoom());
  // 1 m before the left wall's surface, a return of 1.2 m to the left: 0.1 m deep in the wall... of 0.1 m.
  ScanBeams scan;
  scan.beams.push_back({{-0.8, 0.0}, {-1.0, 0.0}, 0.8});
  const ScanFit fit = ScanLikelihood(params, scan).fit(walls, {1.1, 3.0, 0.0});
  const double variance = 0.1 * 0.1 + std::pow(0.05 * 0.8 * 0.8, 2);
  const double hit = std::exp(-0.5 * 0.2 * 0.2 / variance);
  EXPECT_NEAR(fit.explained, hit, 1e-6);
  EXPECT_NEAR(fit.log_likelihood, std::log(params.laser_z_hit * hit + params.laser_z_rand), 1e-6);
}

TEST(ScanLikelihood, isGreatestAtTheTruth) {
  const WallDistance walls(unevenRoom());
  const sarn::Pose2D truth{5.0, 2.0, 2.0};
  const ScanLikelihood scan(LocalizationParams{}, selectBeams(idealScan(walls, truth, 1.02, 640), {}, {}));
  const double best = scan.fit(walls, truth).log_likelihood;
  for (const sarn::Pose2D& off :
       {sarn::Pose2D{0.2, 0.0, 0.0}, sarn::Pose2D{-0.2, 0.0, 0.0}, sarn::Pose2D{0.0, 0.2, 0.0},
        sarn::Pose2D{0.0, 0.0, 0.1}, sarn::Pose2D{0.0, 0.0, -0.1}}) {
    EXPECT_LT(scan.fit(walls, truth * off).log_likelihood, best - 1.0);
  }
}

TEST(ScanLikelihood, ruledOutInsideAWall) {
  const WallDistance walls(unevenRoom());
  const ScanLikelihood scan(LocalizationParams{},
                            selectBeams(idealScan(walls, {4.0, 3.0, 0.0}, 1.02, 60), {}, {}));
  EXPECT_NEAR(scan.fit(walls, {0.05, 3.0, 0.0}).log_likelihood,
              static_cast<double>(scan.scan().beams.size()) * std::log(0.1), 1e-9);
}

class DistanceFilterTest : public testing::Test {
 protected:
  WallDistance walls_{unevenRoom()};
  sarn::Pose2D truth_{4.0, 3.0, -2.5};
  PlanarScan scan_ = idealScan(walls_, truth_, 1.02, 60);
};

TEST_F(DistanceFilterTest, dropsAPersonAndKeepsTheWalls) {
  for (std::size_t i = 20; i < 30; ++i) scan_.ranges[i] = 1.0F;
  const ScanBeams kept = withoutShortBeams(selectBeams(scan_, {}, {}), {truth_}, walls_, {});
  EXPECT_EQ(kept.beams.size(), 50U);
  for (const Beam& beam : kept.beams) EXPECT_GT(beam.range, 1.1);
}

TEST_F(DistanceFilterTest, keepsBeamsThatAreTooLong) {
  for (float& range : scan_.ranges) range += 0.5F;
  EXPECT_EQ(
      withoutShortBeams(selectBeams(scan_, {}, {60, 0.0, 10.0, 0.0}), {truth_}, walls_, {}).beams.size(),
      60U);
}

TEST_F(DistanceFilterTest, keepsWhatTheBeliefDisagreesOn) {
  for (std::size_t i = 20; i < 30; ++i) scan_.ranges[i] = 1.0F;
  const sarn::Pose2D near_wall{0.9, 1.0, 3.1};
  EXPECT_EQ(withoutShortBeams(selectBeams(scan_, {}, {}), {truth_, near_wall}, walls_, {}).beams.size(), 60U);
}

TEST_F(DistanceFilterTest, keepsAllWhenNearlyAllWouldGo) {
  for (float& range : scan_.ranges) range = 0.5F;
  EXPECT_EQ(withoutShortBeams(selectBeams(scan_, {}, {}), {truth_}, walls_, {}).beams.size(), 60U);
}

class CrowdInAHallTest : public testing::Test {
 protected:
  CrowdInAHallTest() {
    for (std::size_t i = 10; i < 40; ++i) scan_.ranges[i] = 2.0F;
  }
  [[nodiscard]] std::size_t kept(const sarn::Pose2D& belief) const {
    return withoutShortBeams(selectBeams(scan_, {}, {60, 0.0, 10.0}), {belief}, walls_, {}).beams.size();
  }
  WallDistance walls_{hall()};
  PlanarScan scan_ = idealScan(walls_, {15.0, 15.0, 0.0}, 1.02, 60);  // the walls are out of reach
};

TEST_F(CrowdInAHallTest, goesThoughItIsAllThatIsSeen) { EXPECT_EQ(kept({15.0, 15.0, 0.0}), 0U); }

TEST_F(CrowdInAHallTest, castsDoubtOnABeliefThatExpectsWallsWhereNothingIs) {
  EXPECT_EQ(kept({23.0, 15.0, 0.0}), 30U);
}

TEST(LikelyPoses, areWhereTheScanFits) {
  const WallDistance walls(unevenRoom());
  const sarn::Pose2D truth{5.0, 2.0, 2.0};
  const ScanLikelihood scan(LocalizationParams{},
                            selectBeams(idealScan(walls, truth, 6.2, 360), {}, {60, 0.0, 20.0, 0.0}));
  std::mt19937_64 random(1);
  const auto poses = drawLikelyPoses(walls, LocalizationParams{}, scan.scan(), 10000, 100, random);
  ASSERT_EQ(poses.size(), 100U);
  int near = 0;
  for (const sarn::Pose2D& pose : poses) {
    if ((pose.position() - truth.position()).norm() < 0.2) ++near;
  }
  EXPECT_GE(near, 90);
}

TEST(RecentScans, layTheReturnsOfAStretchOnTheirWalls) {
  const WallDistance walls(unevenRoom());
  sarn::Pose2D truth{4.0, 1.3, 0.3};
  sarn::Pose2D odometry{-2.0, 5.0, 1.0};
  RecentScans recent;
  std::size_t taken = 0;
  while (!recent.full()) {
    truth = sarn::advance(truth, {0.5, 0.4}, 0.25);
    odometry = sarn::advance(odometry, {0.5, 0.4}, 0.25);
    if (recent.add(odometry, selectBeams(idealScan(walls, truth, 1.02, 120), {}, {}))) ++taken;
    ASSERT_LT(taken, 100U);
  }
  EXPECT_FALSE(recent.add(odometry, ScanBeams{})) << "no motion";
  const ScanBeams seen = recent.seenFrom(odometry);
  EXPECT_EQ(seen.beams.size(), RecentScans::kScans * RecentScans::kMostBeams);
  for (const Beam& beam : seen.beams) EXPECT_LT(walls.at(truth * beam.end, 1.0), 0.02);
  recent.clear();
  EXPECT_FALSE(recent.full());
}

}  // namespace
}  // namespace sarn_localization
