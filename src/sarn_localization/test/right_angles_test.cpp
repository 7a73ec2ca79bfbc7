// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/right_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drawn_map.h"
#include "sarn_common/angles.h"
#include "sarn_localization/wall_lines.h"

namespace sarn_localization {
namespace {

constexpr double kDegree = sarn::kPi / 180.0;

/// Angle [rad] between two lines, in [0, pi / 2].
double between(double a, double b) { return std::abs(std::remainder(a - b, sarn::kPi)); }

/// Ends [m] along a straight wall, with noise [m] across it.
std::vector<Eigen::Vector2d> wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int count,
                                  double noise, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  std::vector<Eigen::Vector2d> ends;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    ends.emplace_back(from + share * (to - from) + noise * normal(generator) * across);
  }
  return ends;
}

WallLineParams evenNoise() {
  WallLineParams params;
  params.sigma = 0.01;
  params.sigma_range = 0.0;
  return params;
}

TEST(WallLines, errAsMuchAsTheySay) {
  double squares = 0.0;
  constexpr int kWalls = 200;
  for (int k = 0; k < kWalls; ++k) {
    const auto ends = wall({2.0, -1.0}, {3.0, 1.0}, 40, 0.01, static_cast<std::uint32_t>(k));
    const auto lines = wallLines(ends, {0.0, 0.0}, evenNoise());
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NEAR(lines[0].length, std::sqrt(5.0), 0.05);
    const double error = between(lines[0].direction, std::atan2(2.0, 1.0)) / lines[0].sigma;
    squares += error * error / kWalls;
  }
  EXPECT_NEAR(squares, 1.0, 0.3);
}

TEST(WallLines, areSplitAtCornersAndGaps) {
  auto ends = wall({2.0, -1.0}, {2.0, 1.0}, 40, 0.0, 1);  // then a corner
  const auto second = wall({2.0, 1.0}, {0.5, 1.0}, 40, 0.0, 1);
  ends.insert(ends.end(), second.begin() + 1, second.end());
  const auto third = wall({0.0, 2.0}, {-2.0, 2.0}, 40, 0.0, 1);  // after a gap
  ends.insert(ends.end(), third.begin(), third.end());
  const auto lines = wallLines(ends, {0.0, 0.0}, evenNoise());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_LT(between(lines[0].direction, 0.5 * sarn::kPi), 0.01);
  EXPECT_LT(between(lines[1].direction, 0.0), 0.01);
  EXPECT_LT(between(lines[2].direction, 0.0), 0.01);
}

TEST(WallLines, leavesOutLegsAndFewReturns) {
  EXPECT_TRUE(wallLines(wall({2.0, 0.0}, {2.0, 0.5}, 40, 0.0, 1), {0.0, 0.0}, evenNoise()).empty());
  EXPECT_TRUE(wallLines(wall({2.0, 0.0}, {2.0, 2.0}, 8, 0.0, 1), {0.0, 0.0}, evenNoise()).empty());
  EXPECT_TRUE(wallLines({}, {0.0, 0.0}, evenNoise()).empty());
  EXPECT_TRUE(wallLines({{1.0, 0.0}}, {0.0, 0.0}, evenNoise()).empty());
}

/// Ranges err along the beams: a wall that is grazed is told better than one that is faced.
TEST(WallLines, grazedWallsTellMore) {
  WallLineParams params;
  const auto faced = wallLines(wall({3.0, -1.0}, {3.0, 1.0}, 60, 0.0, 1), {0.0, 0.0}, params);
  const auto grazed = wallLines(wall({2.0, 0.5}, {4.0, 0.5}, 60, 0.0, 1), {0.0, 0.0}, params);
  ASSERT_EQ(faced.size(), 1U);
  ASSERT_EQ(grazed.size(), 1U);
  EXPECT_LT(grazed[0].sigma, 0.7 * faced[0].sigma);
}

/// What a robot sees of a building turned by `building` [rad] while it turns round and round, by a gyro that
/// is 1 % off; returns the errors of the compass and of the gyro [rad] at the end.
std::pair<double, double> turnAbout(double building, double slanted) {
  constexpr double kStep = 0.15;  // [rad]
  RightAngles compass(0.0);
  double truth = 0.0;
  double gyro = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double wall = building + (i % 3) * 0.5 * sarn::kPi;
    const WallLine straight{wall - truth, 0.003, 2.0};
    const WallLine other{building + slanted - truth, 0.003, 0.8};
    compass.see({straight, other});
    truth += kStep;
    gyro += 1.01 * kStep;
    compass.turn(1.01 * kStep, 0.003 + 0.01 * kStep);
  }
  const auto heading = compass.heading();
  if (!heading) return {1e9, 1e9};
  return {std::abs(sarn::angleDifference(truth, heading->theta)), std::abs(gyro - truth)};
}

TEST(RightAngles, holdsTheHeadingWhereTheGyroDrifts) {
  for (const double building : {0.0, 0.3, -1.2, 2.5}) {
    const auto [error, drift] = turnAbout(building, 0.0);
    EXPECT_LT(error, 0.4 * kDegree) << building;
    EXPECT_GT(drift, 30.0 * kDegree);
  }
}

TEST(RightAngles, leavesOutWallsThatStandAnotherWay) {
  EXPECT_LT(turnAbout(0.2, 0.6).first, 0.4 * kDegree);
  EXPECT_LT(turnAbout(0.2, -0.2).first, 0.4 * kDegree);
}

TEST(RightAngles, takesTheFirstHeadingForTheMaps) {
  RightAngles compass(1.0);
  EXPECT_FALSE(compass.heading());
  compass.see({{0.4, 0.001, 3.0}});
  ASSERT_TRUE(compass.heading());
  EXPECT_DOUBLE_EQ(compass.heading()->theta, 1.0);
  EXPECT_DOUBLE_EQ(compass.heading()->sigma, 0.0);
}

TEST(RightAngles, saysNothingInABuildingWithoutThem) {
  RightAngles compass(0.0);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-sarn::kPi, sarn::kPi);
  int silent = 0;
  for (int i = 0; i < 200; ++i) {
    compass.see({{any(generator), 0.003, 2.0}, {any(generator), 0.003, 2.0}});
    compass.turn(0.1, 0.001);
    if (i >= 20 && !compass.heading()) ++silent;
  }
  EXPECT_GE(silent, 170);
}

TEST(RightAngles, learnsAnewAfterTheRobotWasTurnedByHand) {
  RightAngles compass(0.0);
  for (int i = 0; i < 20; ++i) compass.see({{0.1, 0.003, 2.0}});
  compass.turn(0.0, 0.001);
  for (int i = 0; i < 60; ++i) compass.see({{0.4, 0.003, 2.0}});
  EXPECT_TRUE(compass.heading());
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
