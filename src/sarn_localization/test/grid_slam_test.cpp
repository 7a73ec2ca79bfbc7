// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/grid_slam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drawn_map.h"
#include "sarn_common/angles.h"

namespace sarn_localization {
namespace {

/// Distance [m] from a point to the centre of the nearest wall cell, wherever the point lies.
double nearestWallCell(const sarn::OccupancyMap& map, const Eigen::Vector2d& point) {
  double nearest = 1e9;
  for (int y = 0; y < map.geometry.height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      if (map.at({x, y}) != sarn::kMapOccupied) continue;
      nearest = std::min(nearest, (map.geometry.center({x, y}) - point).norm());
    }
  }
  return nearest;
}

SlamParams params() {
  SlamParams p;
  p.particles = 10;
  p.lskip = 0;
  p.min_range = 0.1;
  p.max_urange = 8.0;
  p.laser_range_bias = 0.0;
  p.laser_beam_offset = 0.0;
  return p;
}

TEST(GridSlam, hasNoMapBeforeTheFirstScan) {
  const GridSlam slam(params());
  EXPECT_FALSE(slam.map());
  EXPECT_FALSE(slam.mapFromOdom());
}

TEST(GridSlam, drawsTheRoomItDrivesThrough) {
  const WallDistance walls(unevenRoom());
  const sarn::OccupancyMap room = unevenRoom();
  const sarn::Pose2D start{4.0, 1.3, 0.3};
  sarn::Pose2D truth = start;
  sarn::Pose2D odometry{7.0, -2.0, 1.0};  // the odometry began elsewhere
  GridSlam slam(params());
  int used = 0;
  for (int i = 0; i < 130; ++i) {
    if (slam.addScan(odometry, {}, idealScan(walls, truth, 2.0, 120))) ++used;
    truth = sarn::advance(truth, {0.5, 0.4}, 0.25);
    odometry = sarn::advance(odometry, {0.503, 0.402}, 0.25);
  }
  EXPECT_GT(used, 50);
  const auto map = slam.map();
  ASSERT_TRUE(map);
  std::vector<double> errors;
  for (int y = 0; y < map->geometry.height; ++y) {
    for (int x = 0; x < map->geometry.width; ++x) {
      if (map->at({x, y}) == sarn::kMapOccupied)
        errors.push_back(nearestWallCell(room, start * map->geometry.center({x, y})));
    }
  }
  ASSERT_GT(errors.size(), 200U);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.10);
  const sarn::Pose2D found = start * *slam.mapFromOdom() * odometry;
  EXPECT_LT((found.position() - truth.position()).norm(), 0.10);
}

/// Error of the heading [rad] after a first turn about, with a gyro that is 2 % off, 1 rad of view, and scan
/// matching that leaves the heading to odometry and walls.
double headingErrorAfterATurn(bool right_angles) {
  const WallDistance walls(unevenRoom());
  sarn::Pose2D truth{4.0, 2.5, 0.0};
  sarn::Pose2D odometry;
  SlamParams turning = params();
  turning.right_angles = right_angles;
  turning.match_exponent = 0.001;
  turning.stt = 0.02;
  turning.initial_pose_x = truth.x;
  turning.initial_pose_y = truth.y;
  GridSlam slam(turning);
  for (int i = 0; i < 20; ++i) {
    slam.addScan(odometry, {}, idealScan(walls, truth, 1.0, 160));
    truth.theta += 0.16;
    odometry.theta += 1.02 * 0.16;
  }
  const sarn::Pose2D found = *slam.mapFromOdom() * odometry;
  return std::abs(sarn::angleDifference(truth.theta, found.theta));
}

TEST(GridSlam, wallsHoldTheHeadingInTheFirstTurn) {
  const double held = headingErrorAfterATurn(true);
  EXPECT_LT(held, 0.02);  // three standard errors of such a gyro between two walls
  EXPECT_GT(headingErrorAfterATurn(false), 0.04);
}

/// Error of the heading [rad] after a robot turned, stood while its gyro drifted by 0.08 rad, and turned on.
double headingErrorAfterAStop(double gyro_drift) {
  const WallDistance walls(unevenRoom());
  sarn::Pose2D truth{4.0, 2.5, 0.0};
  sarn::Pose2D odometry;
  SlamParams turning = params();
  turning.match_exponent = 0.001;
  turning.gyro_drift = gyro_drift;
  turning.initial_pose_x = truth.x;
  turning.initial_pose_y = truth.y;
  GridSlam slam(turning);
  double time = 100.0;
  for (int i = 0; i < 30; ++i) {
    PlanarScan scan = idealScan(walls, truth, 1.0, 160);
    scan.time = time;
    slam.addScan(odometry, {}, scan);
    truth.theta += 0.16;
    odometry.theta += 0.16 + (i == 20 ? 0.08 : 0.0);
    time += i == 20 ? 160.0 : 0.3;
  }
  const sarn::Pose2D found = *slam.mapFromOdom() * odometry;
  return std::abs(sarn::angleDifference(truth.theta, found.theta));
}

TEST(GridSlam, wallsHoldTheHeadingOfARobotThatStoodForLong) {
  EXPECT_LT(headingErrorAfterAStop(SlamParams{}.gyro_drift), 0.02);
  EXPECT_GT(headingErrorAfterAStop(0.0), 0.05) << "the drift is a test at all";
}

TEST(GridSlam, leavesOutScansOfNothing) {
  GridSlam slam(params());
  PlanarScan scan{-0.5, 0.01, 0.1, 8.0, std::vector<float>(100, std::numeric_limits<float>::quiet_NaN())};
  EXPECT_FALSE(slam.addScan({}, {}, scan));
  scan.ranges.assign(100, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(slam.addScan({}, {}, scan));
  scan.ranges.clear();
  EXPECT_FALSE(slam.addScan({}, {}, scan));
  EXPECT_FALSE(slam.map());
}

TEST(GridSlam, takesScansOfAnyBeamCount) {
  const WallDistance walls(unevenRoom());
  GridSlam slam(params());
  EXPECT_TRUE(slam.addScan({}, {}, idealScan(walls, {4.0, 3.0, 0.0}, 1.0, 100)));
  EXPECT_TRUE(slam.addScan({0.3, 0.0, 0.0}, {}, idealScan(walls, {4.3, 3.0, 0.0}, 6.2, 360)));
}

TEST(GridSlam, refusesParametersThatCannotBe) {
  SlamParams bad = params();
  bad.particles = 0;
  EXPECT_THROW(GridSlam{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace sarn_localization
