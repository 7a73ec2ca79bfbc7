// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/robot_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drawn_map.h"
#include "kobuki_sim/kobuki_sensors.h"
#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

constexpr double kRadius = 0.17575;  // [m]
const StaticMap kOpen;
const StaticMap kRoom = drawnMap({"##########",  //
                                  "#........#",  //
                                  "#...#....#",  //
                                  "#........#",  //
                                  "#......#.#",  //
                                  "##########"},
                                 0.3);

PersonState personAt(double x, double y) {
  PersonState person;
  person.position = {x, y};
  person.radius = 0.25;
  return person;
}

TEST(RobotMotion, freeMotionIsTheExactArc) {
  const sarn::Pose2D start{1.0, 2.0, 0.3};
  const RobotStep step = moveRobot(start, {0.5, 0.7}, 0.25, kRadius, kOpen, {});
  const sarn::Pose2D expected = sarn::advance(start, {0.5, 0.7}, 0.25);
  EXPECT_NEAR(step.pose.x, expected.x, 1e-12);
  EXPECT_NEAR(step.pose.y, expected.y, 1e-12);
  EXPECT_NEAR(step.pose.theta, expected.theta, 1e-12);
  EXPECT_NEAR(step.twist.v, 0.5, 1e-12);
  EXPECT_FALSE(step.blocked);
}

TEST(RobotMotion, wallStopsARobotThatDrivesStraightAtIt) {
  sarn::Pose2D pose{1.0, 0.5, 0.0};
  RobotStep step;
  for (int i = 0; i < 300; ++i) {
    step = moveRobot(pose, {0.5, 0.0}, 0.01, kRadius, kRoom, {});
    pose = step.pose;
  }
  EXPECT_NEAR(pose.x, 7 * 0.3 - kRadius, 1e-6);  // the block in the lowest row
  EXPECT_TRUE(step.blocked);
  EXPECT_NEAR(step.twist.v, 0.0, 1e-6);
  EXPECT_EQ(pressedBumpers(pose, kRadius, 1e-3, kRoom, {}), kCentreBit);
}

TEST(RobotMotion, slidesAlongAWallItMeetsAtAnAngle) {
  const StaticMap floor = drawnMap({"....................", "####################"}, 1.0);
  sarn::Pose2D pose{1.0, 1.2, -0.5};
  RobotStep step;
  for (int i = 0; i < 200; ++i) {
    step = moveRobot(pose, {0.3, 0.0}, 0.01, kRadius, floor, {});
    pose = step.pose;
  }
  EXPECT_NEAR(pose.y, 1.0 + kRadius, 1e-6);
  EXPECT_NEAR(step.velocity.x(), 0.3 * std::cos(0.5), 1e-6);  // what is left along the wall
  EXPECT_NEAR(step.velocity.y(), 0.0, 1e-6);
  EXPECT_NEAR(step.twist.v, 0.3 * std::cos(0.5) * std::cos(0.5), 1e-6);
}

// Random driving for a long time, in small and in large steps.
TEST(RobotMotion, neverEntersAWall) {
  for (const double dt : {0.01, 0.25}) {
    RandomStream random(4);
    sarn::Pose2D pose{1.0, 1.2, 0.0};
    sarn::Twist2D twist;
    int blocked = 0;
    for (int i = 0; i < 20000; ++i) {
      if (i % 50 == 0) twist = {random.uniform(-0.7, 0.7), random.uniform(-3.0, 3.0)};
      const RobotStep step = moveRobot(pose, twist, dt, kRadius, kRoom, {personAt(2.0, 1.2)});
      pose = step.pose;
      blocked += step.blocked ? 1 : 0;
      ASSERT_TRUE(kRoom.discFree(pose.position(), kRadius)) << i;
      ASSERT_GE((pose.position() - Eigen::Vector2d(2.0, 1.2)).norm(), kRadius + 0.25 - 1e-9) << i;
      ASSERT_LE(std::abs(step.twist.v), std::abs(twist.v) + 1e-6) << i;
    }
    EXPECT_GT(blocked, 100);
  }
}

TEST(RobotMotion, personStopsARobotThatDrivesAtThem) {
  sarn::Pose2D pose{0.0, 0.0, 0.0};
  for (int i = 0; i < 300; ++i)
    pose = moveRobot(pose, {0.5, 0.0}, 0.01, kRadius, kOpen, {personAt(1.0, 0.0)}).pose;
  EXPECT_NEAR(pose.x, 1.0 - 0.25 - kRadius, 1e-6);
  EXPECT_EQ(pressedBumpers(pose, kRadius, 1e-3, kOpen, {personAt(1.0, 0.0)}), kCentreBit);
}

TEST(RobotMotion, drivesAwayFromAPersonWhoWalkedIntoItButNotDeeper) {
  const std::vector<PersonState> people = {personAt(0.3, 0.0)};
  const sarn::Pose2D pose{0.0, 0.0, 0.0};
  EXPECT_NEAR(moveRobot(pose, {0.5, 0.0}, 0.01, kRadius, kOpen, people).pose.x, 0.0, 1e-12);
  EXPECT_NEAR(moveRobot(pose, {-0.5, 0.0}, 0.01, kRadius, kOpen, people).pose.x, -0.005, 1e-12);
}

TEST(RobotMotion, bumperSectorFollowsTheRobotsHeading) {
  const std::vector<PersonState> people = {personAt(0.4, 0.0)};
  for (const double heading : {0.0, 1.0, 3.1, -3.1}) {
    const double degree = sarn::kPi / 180.0;
    const auto pressed = [&](double bearing) {
      return pressedBumpers({0.0, 0.0, heading}, kRadius, 1e-3, kOpen,
                            {personAt(0.4 * std::cos(heading + bearing), 0.4 * std::sin(heading + bearing))});
    };
    EXPECT_EQ(pressed(0.0), kCentreBit);
    EXPECT_EQ(pressed(60.0 * degree), kLeftBit);
    EXPECT_EQ(pressed(-60.0 * degree), kRightBit);
    EXPECT_EQ(pressed(120.0 * degree), 0);
    EXPECT_EQ(pressed(180.0 * degree), 0);
  }
}

TEST(RobotMotion, severalTouchesPressSeveralBumpers) {
  const StaticMap corner = drawnMap({"..#", "..#", "###"}, 1.0);
  const sarn::Pose2D pose{2.0 - kRadius, 1.0 + kRadius, 0.0};
  EXPECT_EQ(pressedBumpers(pose, kRadius, 1e-3, corner, {}), kCentreBit | kRightBit);
}

}  // namespace
}  // namespace kobuki_sim
