// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/lidar.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <stdexcept>

#include "drawn_map.h"
#include "sarn_common/angles.h"
#include "sarn_common/parameters.h"

namespace kobuki_sim {
namespace {

/// Without noise or losses.
LidarParams exact() {
  LidarParams params;
  params.range_noise = params.drop_probability = 0.0;
  return params;
}

/// A closed room of 8 m x 6 m (inside), its lower left inner corner at (0.5, 0.5).
StaticMap room() {
  std::vector<std::string> rows(14, "#................#");
  rows.front() = rows.back() = "##################";
  return drawnMap(rows, 0.5);
}

PersonState standingAt(double x, double y, double heading) {
  PersonState person;
  person.position = {x, y};
  person.heading = heading;
  return person;
}

/// The beam that looks nearest to a bearing [rad] of the lidar.
std::size_t beamAt(const LidarScan& scan, double bearing) {
  return static_cast<std::size_t>(std::lround((bearing - scan.angle_min) / scan.angle_increment)) %
         scan.ranges.size();
}

double rangeAt(const LidarScan& scan, double bearing) {
  return static_cast<double>(scan.ranges[beamAt(scan, bearing)]);
}

TEST(Lidar, seesWallsAllAround) {
  Lidar lidar(exact(), 1);
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.0}, {}, 0);
  ASSERT_EQ(scan.ranges.size(), 720U);
  EXPECT_NEAR(scan.angle_increment * 720.0, 2.0 * sarn::kPi, 1e-9);
  EXPECT_NEAR(rangeAt(scan, 0.0), 4.0, 1e-6);
  EXPECT_NEAR(rangeAt(scan, 0.5 * sarn::kPi), 3.0, 1e-6);
  EXPECT_NEAR(rangeAt(scan, -sarn::kPi), 4.0, 1e-6);
  EXPECT_NEAR(rangeAt(scan, 0.25 * sarn::kPi), 3.0 * std::sqrt(2.0), 1e-6);
}

TEST(Lidar, turnsWithTheRobotAndStandsWhereItIsMounted) {
  LidarParams params = exact();
  params.mount_x = 0.1;
  params.mount_yaw = 0.5 * sarn::kPi;
  Lidar lidar(params, 1);
  // The robot looks along +y; so the lidar stands 0.1 m farther up and looks along -x.
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.5 * sarn::kPi}, {}, 0);
  EXPECT_NEAR(rangeAt(scan, 0.0), 4.0, 1e-6);
  EXPECT_NEAR(rangeAt(scan, -0.5 * sarn::kPi), 2.9, 1e-6);
  EXPECT_NEAR(rangeAt(scan, 0.5 * sarn::kPi), 3.1, 1e-6);
}

TEST(Lidar, seesTwoLegsOfAPersonAndTheWallBetweenThem) {
  Lidar lidar(exact(), 1);
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.0}, {standingAt(5.7, 3.5, 0.0)}, 0);
  const double left = std::atan2(0.09, 1.2);  // kHalfGait of body_shape.cpp
  EXPECT_NEAR(rangeAt(scan, left), 1.2 - 0.06, 0.02);
  EXPECT_NEAR(rangeAt(scan, -left), 1.2 - 0.06, 0.02);
  EXPECT_NEAR(rangeAt(scan, 0.0), 4.0, 1e-6);
  EXPECT_NEAR(rangeAt(scan, 0.2), 4.0 / std::cos(0.2), 0.01) << "beside the person";
  EXPECT_NEAR(rangeAt(scan, -sarn::kPi), 4.0, 1e-6);
}

TEST(Lidar, seesATorsoAtTheHeightOfTorsos) {
  LidarParams params = exact();
  params.mount_z = 1.2;
  Lidar lidar(params, 1);
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.0}, {standingAt(5.7, 3.5, sarn::kPi)}, 0);
  EXPECT_NEAR(rangeAt(scan, 0.0), 1.2 - 0.12, 1e-6);
}

TEST(Lidar, doesNotSeeWhoIsAbsentOrBehindAWall) {
  PersonState absent = standingAt(5.7, 3.5, 0.0);
  absent.present = false;
  Lidar lidar(exact(), 1);
  const std::vector<float> empty = lidar.measure(room(), {4.5, 3.5, 0.0}, {}, 0).ranges;
  EXPECT_EQ(lidar.measure(room(), {4.5, 3.5, 0.0}, {absent}, 0).ranges, empty);
  EXPECT_EQ(lidar.measure(room(), {4.5, 3.5, 0.0}, {standingAt(12.0, 3.5, 0.0)}, 0).ranges, empty);
}

TEST(Lidar, saysNothingBeyondItsRangeAndTooNear) {
  LidarParams params = exact();
  params.range_max = 3.5;
  params.range_min = 3.2;
  Lidar lidar(params, 1);
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.0}, {}, 0);
  EXPECT_EQ(rangeAt(scan, 0.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(rangeAt(scan, 0.5 * sarn::kPi), -std::numeric_limits<double>::infinity());
}

TEST(Lidar, errsByItsNoiseAndLosesBeams) {
  LidarParams params;
  params.range_noise = 0.02;
  params.drop_probability = 0.1;
  Lidar noisy(params, 1);
  Lidar clean(exact(), 1);
  double squares = 0.0;
  int count = 0;
  int lost = 0;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const std::vector<float> truth = clean.measure(room(), {4.5, 3.5, 0.3}, {}, frame).ranges;
    const std::vector<float> seen = noisy.measure(room(), {4.5, 3.5, 0.3}, {}, frame).ranges;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      lost += std::isinf(seen[i]) ? 1 : 0;
      if (std::isinf(seen[i])) continue;
      const auto error = static_cast<double>(seen[i] - truth[i]);
      squares += error * error;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.001);
  EXPECT_NEAR(lost / (20.0 * 720.0), 0.1, 0.01);
}

TEST(Lidar, isAFunctionOfSeedFrameAndScene) {
  Lidar a(LidarParams{}, 5);
  Lidar b(LidarParams{}, 5);
  Lidar other(LidarParams{}, 6);
  const std::vector<float> first = a.measure(room(), {4.5, 3.5, 0.3}, {}, 7).ranges;
  EXPECT_NE(a.measure(room(), {4.5, 3.5, 0.3}, {}, 8).ranges, first);
  EXPECT_EQ(b.measure(room(), {4.5, 3.5, 0.3}, {}, 7).ranges, first);
  EXPECT_NE(other.measure(room(), {4.5, 3.5, 0.3}, {}, 7).ranges, first);
}

TEST(Lidar, ofLessThanATurnHasABeamAtBothEnds) {
  LidarParams params = exact();
  params.beams = 181;
  params.field_of_view = sarn::kPi;
  Lidar lidar(params, 1);
  const LidarScan& scan = lidar.measure(room(), {4.5, 3.5, 0.0}, {}, 0);
  EXPECT_NEAR(scan.angle_min + 180.0 * scan.angle_increment, 0.5 * sarn::kPi, 1e-9);
  EXPECT_NEAR(static_cast<double>(scan.ranges.front()), 3.0, 1e-6);
  EXPECT_NEAR(static_cast<double>(scan.ranges.back()), 3.0, 1e-6);
}

TEST(LidarParams, theShippedYamlIsTheStructsOwnValues) {
  LidarParams params;
  const YAML::Node yaml = YAML::LoadFile("config/lidar.yaml");
  EXPECT_EQ(sarn::setFromYaml(yaml, params), std::vector<std::string>{});
  for (const auto& name : sarn::fieldNames<LidarParams>()) EXPECT_TRUE(yaml[name]) << name;
  EXPECT_EQ(params.mount_z, LidarParams{}.mount_z);
}

TEST(LidarParams, cannotBeWithoutSense) {
  LidarParams params;
  params.range_min = 20.0;
  EXPECT_THROW(Lidar(params, 1), std::invalid_argument);
}

}  // namespace
}  // namespace kobuki_sim
