// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/contact.h"

#include <gtest/gtest.h>

#include "drawn_map.h"

namespace kobuki_sim {
namespace {

constexpr double kDt = 0.01;  // [s]

PersonState personAt(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity = {0.0, 0.0}) {
  PersonState person;
  person.name = "anna";
  person.position = position;
  person.velocity = velocity;
  return person;
}

/// Feeds one step at a time.
struct Watch {
  ContactMonitor monitor;
  StaticMap map;
  double time = 0.0;

  std::vector<Contact> see(const RobotDisc& robot, const std::vector<PersonState>& people) {
    std::vector<Contact> events;
    time += kDt;
    monitor.update(time, kDt, robot, people, map, events);
    return events;
  }
};

TEST(ContactMonitor, reportsFirstTouchWithTheSpeedsOfBothSides) {
  Watch watch;
  const RobotDisc robot{{0.0, 0.0}, {0.3, 0.0}, 0.2};
  EXPECT_TRUE(watch.see(robot, {personAt({0.46, 0.0}, {-1.0, 0.5})}).empty());
  const auto events = watch.see(robot, {personAt({0.45, 0.0}, {-1.0, 0.5})});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].other, "anna");
  EXPECT_EQ(events[0].person, 0);
  EXPECT_NEAR(events[0].time, 0.02, 1e-12);
  EXPECT_NEAR(events[0].point.x(), 0.2, 1e-12);
  EXPECT_NEAR(events[0].robot_closing_speed, 0.3, 1e-12);
  EXPECT_NEAR(events[0].other_closing_speed, 1.0, 1e-12);
  EXPECT_NEAR(events[0].robot_speed, 0.3, 1e-12);
  EXPECT_EQ(events[0].standing_time, 0.0);
}

TEST(ContactMonitor, robotThatMovesAwayHasNegativeClosingSpeed) {
  Watch watch;
  const auto events = watch.see({{0.0, 0.0}, {-0.3, 0.0}, 0.2}, {personAt({0.44, 0.0}, {1.0, 0.0})});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].robot_closing_speed, -0.3, 1e-12);
  EXPECT_NEAR(events[0].other_closing_speed, -1.0, 1e-12);
}

TEST(ContactMonitor, knowsHowLongTheRobotStood) {
  Watch watch;
  const RobotDisc standing{{0.0, 0.0}, {0.0, 0.0}, 0.2};
  for (int i = 0; i < 149; ++i) EXPECT_TRUE(watch.see(standing, {personAt({2.0, 0.0})}).empty());
  const auto events = watch.see(standing, {personAt({0.44, 0.0}, {-1.0, 0.0})});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].standing_time, 1.5, 1e-9);
  EXPECT_EQ(events[0].robot_closing_speed, 0.0);
}

TEST(ContactMonitor, aTouchEndsOnlyAfterHalfASecondApart) {
  Watch watch;
  const RobotDisc robot{{0.0, 0.0}, {0.0, 0.0}, 0.2};
  const std::vector<PersonState> touching = {personAt({0.44, 0.0})};
  const std::vector<PersonState> apart = {personAt({0.6, 0.0})};
  EXPECT_EQ(watch.see(robot, touching).size(), 1U);
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(watch.see(robot, touching).empty());
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(watch.see(robot, apart).empty());
  EXPECT_TRUE(watch.see(robot, touching).empty());
  for (int i = 0; i < 60; ++i) EXPECT_TRUE(watch.see(robot, apart).empty());
  EXPECT_EQ(watch.see(robot, touching).size(), 1U);
}

TEST(ContactMonitor, countsEachPersonAndTheWallApart) {
  Watch watch;
  watch.map = drawnMap({"..#", "..#"}, 1.0);
  PersonState bert = personAt({1.8 - 0.44, 1.0});
  bert.id = 1;
  bert.name = "bert";
  PersonState anna = personAt({1.8, 1.44});
  const RobotDisc robot{{1.8, 1.0}, {0.1, 0.0}, 0.2};
  const auto events = watch.see(robot, {anna, bert});
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].other, "wall");
  EXPECT_EQ(events[0].person, -1);
  EXPECT_NEAR(events[0].robot_closing_speed, 0.1, 1e-12);
  EXPECT_EQ(events[1].other, "anna");
  EXPECT_EQ(events[2].other, "bert");
}

TEST(ContactMonitor, peopleWhoAreNotPresentTouchNobody) {
  Watch watch;
  PersonState anna = personAt({0.1, 0.0});
  anna.present = false;
  EXPECT_TRUE(watch.see({{0.0, 0.0}, {0.0, 0.0}, 0.2}, {anna}).empty());
}

}  // namespace
}  // namespace kobuki_sim
