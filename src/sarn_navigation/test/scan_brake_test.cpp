// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/scan_brake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sarn_navigation/swept_corridor.h"

namespace sarn_navigation {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kHalfView = 0.51;  // [rad]
constexpr int kBeams = 128;

/// What the depth camera at (x, y, yaw) sees of a wall at x = wall.
Scan scanOfWall(const sarn::Pose2D& sensor, double wall, double range_min) {
  Scan scan{-kHalfView, 2.0 * kHalfView / (kBeams - 1), range_min, 10.0, {}};
  for (int i = 0; i < kBeams; ++i) {
    const double angle = sensor.theta + scan.angle_min + i * scan.angle_increment;
    const double range = std::cos(angle) > 1e-6 ? (wall - sensor.x) / std::cos(angle) : kInf;
    scan.ranges.push_back(range < range_min ? std::numeric_limits<double>::quiet_NaN() : range);
  }
  return scan;
}

/// Drives a robot of perfect obedience (decelerations bounded) at a wall; returns the pose after `time` [s].
sarn::Pose2D driveAtWall(const ScanBrakeParams& params, sarn::Pose2D pose, double wall, double speed,
                         double time) {
  const double dt = 0.02;  // [s]
  ScanBrake brake(params);
  sarn::Twist2D moving;
  for (double now = 1.0; now < 1.0 + time; now += dt) {
    brake.insertScan(scanOfWall(pose, wall, 0.45), pose, now);
    const sarn::Twist2D command = brake.limit({speed, 0.0}, pose, now).twist;
    const double change = params.deceleration * dt;
    moving.v = std::max(command.v, moving.v - change);
    pose = sarn::advance(pose, moving, dt);
  }
  return pose;
}

TEST(LimitToFreeSpace, leavesAFreeWayAlone) {
  const sarn::Twist2D wanted{0.5, 0.3};
  const sarn::Twist2D limited = limitToFreeSpace(wanted, {{3.0, 0.0}, {-0.5, 0.0}, {0.1, 0.4}}, {});
  EXPECT_DOUBLE_EQ(limited.v, wanted.v);
  EXPECT_DOUBLE_EQ(limited.omega, wanted.omega);
}

TEST(LimitToFreeSpace, isTheFormulaStraightAhead) {
  const ScanBrakeParams params;
  for (double x = 0.3; x < 0.6; x += 0.05) {
    const double free = x - params.robot_radius - params.margin - params.stop_margin;
    const double expected =
        std::min(0.8, speedThatStopsWithin(free, params.reaction_time, params.deceleration));
    EXPECT_NEAR(limitToFreeSpace({0.8, 0.0}, {{x, 0.0}}, params).v, expected, 1e-3) << x;
  }
}

TEST(LimitToFreeSpace, stopsAtContactButLetsTheRobotTurnAndLeave) {
  const std::vector<Eigen::Vector2d> wall{{0.2, -0.1}, {0.2, 0.0}, {0.2, 0.1}};
  EXPECT_DOUBLE_EQ(limitToFreeSpace({0.5, 0.0}, wall, {}).v, 0.0);
  EXPECT_DOUBLE_EQ(limitToFreeSpace({0.5, 0.7}, wall, {}).omega, 0.7);
  EXPECT_DOUBLE_EQ(limitToFreeSpace({0.0, 0.7}, wall, {}).omega, 0.7);
  EXPECT_DOUBLE_EQ(limitToFreeSpace({-0.2, 0.0}, wall, {}).v, -0.2);
}

TEST(LimitToFreeSpace, passesAlongAWallBesideTheRobot) {
  std::vector<Eigen::Vector2d> wall;
  for (double x = -0.5; x < 2.0; x += 0.05) wall.emplace_back(x, 0.21);
  EXPECT_DOUBLE_EQ(limitToFreeSpace({0.5, 0.0}, wall, {}).v, 0.5);
}

TEST(LimitToFreeSpace, resultIsAlwaysAbleToStop) {
  const ScanBrakeParams params;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int limited_count = 0;
  for (int i = 0; i < 500; ++i) {
    const sarn::Twist2D wanted{0.8 * place(random), 2.0 * place(random)};
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < 10; ++k) points.emplace_back(place(random), place(random));
    const sarn::Twist2D limited = limitToFreeSpace(wanted, points, params);
    EXPECT_DOUBLE_EQ(limited.omega, wanted.omega);
    EXPECT_GE(limited.v * wanted.v, 0.0);
    EXPECT_LE(std::abs(limited.v), std::abs(wanted.v));
    limited_count += std::abs(limited.v) < std::abs(wanted.v) ? 1 : 0;
    if (limited.v == 0.0) continue;
    const double stop =
        stoppingDistance(limited.v, params.reaction_time, params.deceleration) + params.stop_margin;
    for (const auto& p : points) {
      EXPECT_GE(freeDistance(limited, p, params.robot_radius + params.margin), stop - 1e-9);
    }
  }
  EXPECT_GT(limited_count, 50);
}

TEST(ScanBrake, standsStillWithoutAScan) {
  ScanBrake brake{ScanBrakeParams{}};
  const BrakeDecision decision = brake.limit({0.5, 0.5}, sarn::Pose2D{}, 1.0);
  EXPECT_EQ(decision.reason, BrakeReason::kNoScan);
  EXPECT_DOUBLE_EQ(decision.twist.v, 0.0);
  EXPECT_DOUBLE_EQ(decision.twist.omega, 0.0);
}

TEST(ScanBrake, standsStillOnAnOldScanWithoutAPoseAndAfterAReset) {
  ScanBrake brake{ScanBrakeParams{}};
  brake.insertScan(scanOfWall({}, 5.0, 0.45), {}, 1.0);
  EXPECT_EQ(brake.limit({0.5, 0.0}, sarn::Pose2D{}, 1.4).reason, BrakeReason::kNone);
  EXPECT_EQ(brake.limit({0.5, 0.0}, std::nullopt, 1.4).reason, BrakeReason::kNoPose);
  EXPECT_DOUBLE_EQ(brake.limit({0.5, 0.0}, std::nullopt, 1.4).twist.v, 0.0);
  EXPECT_EQ(brake.limit({0.5, 0.0}, sarn::Pose2D{}, 1.6).reason, BrakeReason::kOldScan);
  EXPECT_DOUBLE_EQ(brake.limit({0.5, 0.0}, sarn::Pose2D{}, 1.6).twist.v, 0.0);
  brake.reset();
  EXPECT_EQ(brake.limit({0.5, 0.0}, sarn::Pose2D{}, 1.0).reason, BrakeReason::kNoScan);
}

TEST(ScanBrake, stopsInFrontOfAWallAtAnySpeed) {
  const ScanBrakeParams params;
  for (const double speed : {0.2, 0.5, 0.8}) {
    const sarn::Pose2D end = driveAtWall(params, {}, 2.0, speed, 20.0);
    const double gap = 2.0 - end.x - params.robot_radius;
    EXPECT_GE(gap, params.margin) << speed;
    EXPECT_LE(gap, params.margin + params.stop_margin + 0.05) << speed;
  }
}

TEST(ScanBrake, staysStoppedAtAWallThatIsTooNearToBeSeen) {
  const ScanBrakeParams params;  // the camera sees nothing nearer than 0.45 m, the robot stops at 0.25 m
  const sarn::Pose2D end = driveAtWall(params, {}, 1.0, 0.3, 0.9 * params.near_memory_time);
  EXPECT_LT(end.x, 1.0 - params.robot_radius);
}

TEST(ScanBrake, remembersAnObstacleThatLeftTheViewWhileTurning) {
  ScanBrake brake{ScanBrakeParams{}};
  brake.insertScan(scanOfWall({}, 0.46, 0.45), {}, 1.0);
  const sarn::Pose2D turned{0.0, 0.0, 1.2};  // the wall now lies at the right
  brake.insertScan(scanOfWall(turned, 10.0, 0.45), turned, 1.5);
  EXPECT_LT(brake.limit({0.8, -1.6}, turned, 1.5).twist.v, 0.75);
}

TEST(ScanBrake, theAnswerDoesNotDependOnTheOdomFrame) {
  const sarn::Pose2D odom_shift{3.0, -7.0, 2.0};
  ScanBrake here{ScanBrakeParams{}};
  ScanBrake there{ScanBrakeParams{}};
  const Scan scan = scanOfWall({}, 0.55, 0.45);
  here.insertScan(scan, {}, 1.0);
  there.insertScan(scan, odom_shift, 1.0);
  const double v_here = here.limit({0.8, 0.2}, sarn::Pose2D{}, 1.0).twist.v;
  EXPECT_LT(v_here, 0.7);
  EXPECT_NEAR(v_here, there.limit({0.8, 0.2}, odom_shift, 1.0).twist.v,
              0.03);  // other cells keep other points
}

}  // namespace
}  // namespace sarn_navigation
