// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/timed_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sarn_move_base {
namespace {

const DriveLimits kLimits{0.5, 1.0, 1.0, 2.0};

/// A trajectory as the planner makes it: actions of 0.25 s that change speeds by whole steps.
sarn::TimedTrajectory latticeTrajectory() {
  sarn::TimedTrajectory trajectory;
  sarn::TrajectoryPoint point{1.0, 2.0, 3.0, 0.25, 0.5, 50.0};  // begins while moving
  trajectory.points.push_back(point);
  const double speeds[][2] = {{0.5, 0.5},  {0.5, 1.0},  {0.25, 0.5}, {0.5, 0.0},
                              {0.5, -0.5}, {0.25, 0.0}, {0.0, 0.0}};
  for (const auto& s : speeds) {
    const sarn::Twist2D mean{0.5 * (point.v + s[0]), 0.5 * (point.omega + s[1])};
    const sarn::Pose2D pose = sarn::advance(point.pose(), mean, 0.25);
    point = {pose.x, pose.y, pose.theta, s[0], s[1], point.t + 0.25};
    trajectory.points.push_back(point);
  }
  return trajectory;
}

TEST(TimedPlan, speedsAndGoalSurviveThePathOfPoses) {
  const TimedPlan plan{latticeTrajectory(), {4.0, 5.0, -0.5}};
  const TimedPlan read = decode(encode(plan), kLimits, {}, 0.0);
  ASSERT_EQ(read.trajectory.points.size(), plan.trajectory.points.size());
  for (std::size_t i = 0; i < read.trajectory.points.size(); ++i) {
    EXPECT_NEAR(read.trajectory.points[i].v, plan.trajectory.points[i].v, 1e-9) << i;
    EXPECT_NEAR(read.trajectory.points[i].omega, plan.trajectory.points[i].omega, 1e-9) << i;
    EXPECT_DOUBLE_EQ(read.trajectory.points[i].t, plan.trajectory.points[i].t) << i;
  }
  EXPECT_DOUBLE_EQ(read.goal.x, 4.0);
  EXPECT_DOUBLE_EQ(read.goal.theta, -0.5);
}

TEST(TimedPlan, reverseMotionKeepsItsSign) {
  sarn::TimedTrajectory back;
  back.points = {
      {0.0, 0.0, 0.0, 0.0, 0.0, 1.0}, {-0.125, 0.0, 0.0, -0.25, 0.0, 2.0}, {-0.25, 0.0, 0.0, 0.0, 0.0, 3.0}};
  const TimedPlan read = decode(encode({back, {-0.25, 0.0, 0.0}}), kLimits, {}, 0.0);
  EXPECT_NEAR(read.trajectory.points[1].v, -0.25, 1e-9);
}

TEST(TimedPlan, allPosesTimedMeansTheLastOneIsTheGoal) {
  std::vector<StampedPose> poses = encode({latticeTrajectory(), {}});
  poses.pop_back();
  const TimedPlan read = decode(poses, kLimits, {}, 0.0);
  EXPECT_EQ(read.trajectory.points.size(), poses.size());
  EXPECT_DOUBLE_EQ(read.goal.x, poses.back().pose.x);
}

TEST(TimedPlan, speedsOfAnEndThatMovesAreNotBelieved) {
  // Half a metre a second to the last pose: backwards that means 0, 1, 0, 1 m/s.
  std::vector<StampedPose> poses;
  for (int i = 0; i < 5; ++i) poses.push_back({{0.5 * i, 0.0, 0.0}, 1.0 + i});
  const TimedPlan read = decode(poses, kLimits, {}, 0.0);
  for (std::size_t i = 0; i + 1 < 5; ++i) EXPECT_NEAR(read.trajectory.points[i].v, 0.5, 1e-9) << i;
}

TEST(TimedPlan, planWithoutTimesIsDrivenFromNow) {
  const TimedPlan read = decode({{{0.0, 0.0, 0.0}, 0.0}, {{1.0, 0.0, 0.0}, 0.0}}, kLimits, {0.3, 0.0}, 20.0);
  EXPECT_DOUBLE_EQ(read.trajectory.startTime(), 20.0);
  EXPECT_DOUBLE_EQ(read.trajectory.points.front().v, 0.3);
  EXPECT_DOUBLE_EQ(read.goal.x, 1.0);
}

TEST(TimedPlan, oneStampForAllPosesIsNoTime) {
  const TimedPlan read =
      decode({{{0.0, 0.0, 0.0}, 5.0}, {{1.0, 0.0, 0.0}, 5.0}, {{2.0, 0.0, 0.0}, 5.0}}, kLimits, {}, 20.0);
  EXPECT_DOUBLE_EQ(read.trajectory.startTime(), 20.0);
  EXPECT_NEAR(read.trajectory.length(), 2.0, 1e-3);
}

TEST(TimedPlan, refusesWhatIsNotFiniteAndNamesThePose) {
  EXPECT_THROW((void)decode({}, kLimits, {}, 0.0), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  try {
    (void)decode({{{0.0, 0.0, 0.0}, 1.0}, {{nan, 0.0, 0.0}, 2.0}}, kLimits, {}, 0.0);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("pose 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sarn_move_base
