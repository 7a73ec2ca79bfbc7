// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "drawn_scene.h"
#include "sarn_navigation/reachable_area.h"
#include "sarn_navigation/yield_monitor.h"
#include "sarn_navigation/yield_spot.h"

namespace sarn_navigation {
namespace {

sarn::PeoplePrediction walker(double stamp, const Eigen::Vector2d& position,
                              const Eigen::Vector2d& velocity) {
  return {stamp, 0.5, {{"anna", "", {{position, velocity, 0.1}}}}};
}

TEST(YieldMonitor, tellsWhoseStraightWayLeadsThroughTheRobot) {
  YieldMonitor monitor({});
  monitor.observe(walker(1.0, {3.0, 0.2}, {-1.0, 0.0}));
  const auto blocked = monitor.blockedBy({0.0, 0.0});
  ASSERT_TRUE(blocked);
  EXPECT_EQ(blocked->name, "anna");
  EXPECT_FALSE(monitor.blockedBy({0.0, 1.5})) << "passes at 1.3 m";
  EXPECT_FALSE(monitor.blockedBy({4.0, 0.2})) << "has passed already";
  EXPECT_FALSE(monitor.blockedBy({-9.0, 0.2})) << "too far ahead for the horizon";
}

TEST(YieldMonitor, remembersWhereAPersonWhoHaltedWantedToGo) {
  YieldMonitor monitor({});
  monitor.observe(walker(1.0, {1.2, 0.0}, {-0.8, 0.0}));
  monitor.observe(walker(2.0, {0.8, 0.0}, {0.0, 0.0}));
  EXPECT_TRUE(monitor.blockedBy({0.0, 0.0}));
  monitor.observe(walker(9.0, {0.8, 0.0}, {0.0, 0.0}));
  EXPECT_FALSE(monitor.blockedBy({0.0, 0.0})) << "stands there for long: wants to be there";
}

TEST(YieldMonitor, ignoresPeopleWhoAlwaysStood) {
  YieldMonitor monitor({});
  monitor.observe(walker(1.0, {0.8, 0.0}, {0.0, 0.0}));
  EXPECT_FALSE(monitor.blockedBy({0.0, 0.0}));
}

TEST(PathLengths, goAroundWalls) {
  DrawnScene scene({"...#...", "...#...", "...#...", "......."});
  const auto lengths = pathLengths(scene.view(), {0.1, 0.9});
  EXPECT_FLOAT_EQ(lengths.at({0, 3}), 0.0F);
  EXPECT_EQ(lengths.at({3, 3}), kUnreachable);
  EXPECT_NEAR(lengths.at({6, 3}), 0.25 * (6 * std::sqrt(2.0)), 1e-5);
  EXPECT_EQ(pathLengths(scene.view(), {0.1, 0.9}, 1.0).at({6, 3}), kUnreachable);
}

/// A corridor of 1 m along x with a niche above it.
DrawnScene corridorWithNiche() {
  return DrawnScene({"########################", "############....########", "############....########",
                     "############....########", "........................", "........................",
                     "........................", "........................", "########################"});
}

TEST(YieldSpot, isTheNicheBesideTheCorridor) {
  DrawnScene scene = corridorWithNiche();
  const BlockedPerson person{"anna", {5.5, 0.75}, {-1.0, 0.0}};
  const auto spot = findYieldSpot({2.0, 0.75, 0.0}, person, scene.view(), {});
  ASSERT_TRUE(spot);
  EXPECT_GT(spot->y, 0.75 + NavigatorParams().yield_distance);
  EXPECT_GT(spot->x, 3.0);
  EXPECT_LT(spot->x, 4.0);
  EXPECT_NEAR(spot->theta, -sarn::kPi / 2, 1e-6) << "faces the person's line";
}

TEST(YieldSpot, isNoneWithoutRoom) {
  DrawnScene scene({"##########", "..........", "..........", "##########"});
  EXPECT_FALSE(findYieldSpot({1.0, 0.5, 0.0}, {"anna", {2.4, 0.5}, {-1.0, 0.0}}, scene.view(), {}));
}

TEST(YieldSpot, keepsAwayFromOtherPeople) {
  DrawnScene scene = corridorWithNiche();
  scene.addEmptyLayer();
  scene.forbid(0, {3.5, 1.7}, 1.0);
  EXPECT_FALSE(findYieldSpot({2.0, 0.75, 0.0}, {"anna", {5.5, 0.75}, {-1.0, 0.0}}, scene.view(), {}));
}

}  // namespace
}  // namespace sarn_navigation
