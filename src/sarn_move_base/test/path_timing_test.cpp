// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/path_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_move_base {
namespace {

const DriveLimits kLimits{0.5, 1.0, 1.0, 2.0};

/// What any timed path must keep: times grow, speeds and accelerations stay inside, neighbouring poses are
/// joined by the arc of their mean speeds, it ends standing.
void expectDrivable(const sarn::TimedTrajectory& trajectory) {
  const auto& points = trajectory.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(std::abs(points[i].v), kLimits.max_vel_x + 1e-9) << i;
    EXPECT_LE(std::abs(points[i].omega), kLimits.max_vel_theta + 1e-9) << i;
    if (i == 0) continue;
    const double dt = points[i].t - points[i - 1].t;
    ASSERT_GT(dt, 0.0) << i;
    EXPECT_LE(std::abs(points[i].v - points[i - 1].v), kLimits.acc_lim_x * dt + 1e-6) << i;
    const sarn::Pose2D reached = trajectory.sample(points[i].t - 1e-9).pose();
    EXPECT_LT((reached.position() - points[i].pose().position()).norm(), 0.01) << i;
    EXPECT_LT(std::abs(sarn::angleDifference(reached.theta, points[i].theta)), 0.06) << i;
  }
  EXPECT_DOUBLE_EQ(points.back().v, 0.0);
  EXPECT_DOUBLE_EQ(points.back().omega, 0.0);
}

TEST(PathTiming, straightLineTakesTheTimeOfATrapezoid) {
  std::vector<sarn::Pose2D> path;
  for (int i = 0; i <= 40; ++i) path.push_back({0.05 * i, 0.0, 0.0});
  const auto trajectory = timePath(path, kLimits, 0.0, 100.0);
  expectDrivable(trajectory);
  // 2 m at 0.5 m/s with ramps of 0.5 s: 4 s + 0.5 s.
  EXPECT_NEAR(trajectory.endTime() - trajectory.startTime(), 4.5, 0.02);
  EXPECT_DOUBLE_EQ(trajectory.startTime(), 100.0);
}

TEST(PathTiming, rollingStartKeepsTheSpeed) {
  const auto trajectory = timePath({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}, kLimits, 0.4, 0.0);
  expectDrivable(trajectory);
  EXPECT_DOUBLE_EQ(trajectory.points.front().v, 0.4);
}

TEST(PathTiming, turnsInPlaceTowardsThePathAndToTheGoalsHeading) {
  const auto trajectory = timePath({{0.0, 0.0, -1.5}, {1.0, 0.0, 2.0}}, kLimits, 0.0, 0.0);
  expectDrivable(trajectory);
  EXPECT_NEAR(trajectory.points.front().theta, -1.5, 1e-9);
  EXPECT_NEAR(trajectory.points.back().theta, 2.0, 1e-6);
  EXPECT_NEAR(trajectory.points.back().x, 1.0, 1e-6);
  EXPECT_NEAR(trajectory.length(), 1.0, 1e-3);
  // Turns of 1.5 and 2 rad at 1 rad/s with ramps of 0.5 s, 1 m at 0.5 m/s with ramps of 0.5 s.
  EXPECT_NEAR(trajectory.endTime(), 2.0 + 2.5 + 2.5, 0.02);
}

TEST(PathTiming, cornerIsRoundedAndStaysBesideTheCorner) {
  const auto trajectory = timePath({{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 2.0, 1.57}}, kLimits, 0.0, 0.0);
  expectDrivable(trajectory);
  double slowest = 1.0;
  for (const auto& point : trajectory.points) {
    if (point.t > 1.0 && point.t < trajectory.endTime() - 1.0) slowest = std::min(slowest, point.v);
  }
  EXPECT_GT(slowest, 0.4) << "drives through";
  EXPECT_NEAR(trajectory.points.back().x, 2.0, 1e-6);
  EXPECT_NEAR(trajectory.points.back().y, 2.0, 1e-6);
}

TEST(PathTiming, gridPathOfShortStepsIsDrivenWithoutStopping) {
  std::vector<sarn::Pose2D> path;  // steps of one cell, straight and diagonal in turn
  double x = 0.0;
  double y = 0.0;
  for (int i = 0; i < 60; ++i) {
    path.push_back({x, y, 0.0});
    x += 0.05;
    if (i % 2 == 0) y += 0.05;
  }
  const auto trajectory = timePath(path, kLimits, 0.0, 0.0);
  expectDrivable(trajectory);
  EXPECT_LT(trajectory.endTime(), 3.3 / 0.5 + 3.5);
}

TEST(PathTiming, turningBackStopsFirst) {
  const auto trajectory = timePath({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.01, 3.14}}, kLimits, 0.0, 0.0);
  expectDrivable(trajectory);
  EXPECT_NEAR(trajectory.points.back().x, 0.0, 1e-6);
}

TEST(PathTiming, onePoseIsStandingThere) {
  const auto trajectory = timePath({{1.0, 2.0, 0.5}}, kLimits, 0.3, 7.0);
  ASSERT_EQ(trajectory.points.size(), 1U);
  EXPECT_DOUBLE_EQ(trajectory.points.front().t, 7.0);
  EXPECT_DOUBLE_EQ(trajectory.points.front().v, 0.0);
}

}  // namespace
}  // namespace sarn_move_base
