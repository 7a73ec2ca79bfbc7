// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/pose_pair_matcher.h"

#include <gtest/gtest.h>

#include <random>

namespace sarn_localization {
namespace {

using sarn::Pose2D;

void expectNear(const Pose2D& a, const Pose2D& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(sarn::angleDifference(a.theta, b.theta), 0.0, 1e-12);
}

TEST(MapFromOdom, isIdentityWithoutDrift) {
  const Pose2D pose{1.0, 2.0, 3.0};
  expectNear(mapFromOdom({0, pose, pose}), Pose2D{});
}

TEST(MapFromOdom, isTheTruthWhileTheOdometryIsAtItsOrigin) {
  const Pose2D pose{1.0, 2.0, 3.0};
  expectNear(mapFromOdom({0, pose, Pose2D{}}), pose);
}

TEST(MapFromOdom, turnsTheOdometryIntoTheTruth) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> metres(-20.0, 20.0);
  std::uniform_real_distribution<double> radians(-3.14, 3.14);
  for (int i = 0; i < 200; ++i) {
    const Pose2D robot_in_map{metres(random), metres(random), radians(random)};
    const Pose2D robot_in_odom{metres(random), metres(random), radians(random)};
    expectNear(mapFromOdom({0, robot_in_map, robot_in_odom}) * robot_in_odom, robot_in_map);
  }
}

TEST(PosePairMatcher, pairsEqualStampsInEitherOrder) {
  PosePairMatcher matcher;
  EXPECT_FALSE(matcher.addTruth(10, {1, 0, 0}));
  const auto first = matcher.addOdometry(10, {2, 0, 0});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->stamp, 10);
  EXPECT_EQ(first->robot_in_map.x, 1);
  EXPECT_EQ(first->robot_in_odom.x, 2);
  EXPECT_FALSE(matcher.addOdometry(20, {3, 0, 0}));
  const auto second = matcher.addTruth(20, {4, 0, 0});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->robot_in_map.x, 4);
  EXPECT_EQ(second->robot_in_odom.x, 3);
}

TEST(PosePairMatcher, neverPairsDifferentStamps) {
  PosePairMatcher matcher;
  EXPECT_FALSE(matcher.addTruth(10, {}));
  EXPECT_FALSE(matcher.addOdometry(11, {}));
  EXPECT_FALSE(matcher.addTruth(12, {}));
}

TEST(PosePairMatcher, pairsAStreamThatLagsBehind) {
  PosePairMatcher matcher;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(matcher.addTruth(i, {static_cast<double>(i), 0, 0}));
  for (int i = 0; i < 50; ++i) {
    const auto pair = matcher.addOdometry(i, {});
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->robot_in_map.x, i);
  }
}

TEST(PosePairMatcher, forgetsTheOldestBeyondItsCapacity) {
  PosePairMatcher matcher(3);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(matcher.addTruth(i, {}));
  EXPECT_FALSE(matcher.addOdometry(1, {}));
  EXPECT_TRUE(matcher.addOdometry(2, {}));
}

TEST(PosePairMatcher, goesOnAfterTheClockJumpedBack) {
  PosePairMatcher matcher;
  for (int i = 100; i < 120; ++i) {
    EXPECT_FALSE(matcher.addTruth(i, {}));
    EXPECT_TRUE(matcher.addOdometry(i, {}));
  }
  EXPECT_FALSE(matcher.addTruth(120, {99, 0, 0}));
  for (int i = 0; i < 130; ++i) {
    EXPECT_FALSE(matcher.addTruth(i, {static_cast<double>(i), 0, 0}));
    const auto pair = matcher.addOdometry(i, {});
    ASSERT_TRUE(pair) << i;
    EXPECT_EQ(pair->robot_in_map.x, i) << "a pose from before the jump was used";
  }
}

TEST(PosePairMatcher, usesTheNewerOfTwoPosesWithOneStamp) {
  PosePairMatcher matcher;
  EXPECT_FALSE(matcher.addOdometry(5, {1, 0, 0}));
  EXPECT_FALSE(matcher.addOdometry(5, {2, 0, 0}));
  const auto pair = matcher.addTruth(5, {});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->robot_in_odom.x, 2);
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
