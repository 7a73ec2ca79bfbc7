// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "drawn_map.h"

namespace kobuki_sim {
namespace {

/// Robot at the origin of its room, ten people who cross it all the time.
Scenario busyRoom() {
  Scenario scenario;
  scenario.name = "busy room";
  scenario.source = "busy_room.yaml";
  scenario.robot_pose = {5.0, 5.0, 0.0};
  scenario.jitter = {0.2, 1.0, 0.1};
  for (int i = 0; i < 10; ++i) {
    const double angle = 2.0 * sarn::kPi * i / 10.0;
    const Eigen::Vector2d offset = 3.5 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    PersonSpec person;
    person.name = "person " + std::to_string(i);
    person.model = i % 2 == 0 ? PersonModel::kOrca : PersonModel::kSocialForce;
    person.position = Eigen::Vector2d(5.0, 5.0) + offset;
    person.waypoints = {Eigen::Vector2d(5.0, 5.0) - offset, person.position};
    person.reacts_to_robot = i % 3 != 0;
    scenario.people.push_back(person);
  }
  return scenario;
}

std::shared_ptr<const StaticMap> room() {
  std::vector<std::string> rows(50, "#" + std::string(48, '.') + "#");
  rows.front() = rows.back() = std::string(50, '#');
  rows[20].replace(10, 8, "########");
  return std::make_shared<const StaticMap>(drawnMap(rows, 0.2));
}

/// A wandering command that depends on the step only.
void driveAbout(World& world) {
  const double t = world.time();
  world.base().commandVelocity(0.3 + 0.2 * std::sin(0.7 * t), 1.2 * std::sin(0.3 * t));
}

std::vector<std::uint64_t> digestsOf(std::uint64_t seed, double duration) {
  World world(busyRoom(), room(), seed);
  std::vector<std::uint64_t> digests;
  while (world.time() < duration) {
    driveAbout(world);
    world.step();
    if (world.steps() % 100 == 0) digests.push_back(world.digest());
  }
  return digests;
}

TEST(World, sameSeedIsBitIdenticalForAMinuteAndAnotherSeedDiffers) {
  const auto first = digestsOf(7, 60.0);
  EXPECT_EQ(first, digestsOf(7, 60.0));
  const auto other = digestsOf(8, 60.0);
  ASSERT_EQ(first.size(), other.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NE(first[i], other[i]);
}

TEST(World, resetEqualsANewWorldAndACopyGoesItsOwnWay) {
  World world(busyRoom(), room(), 3);
  for (int i = 0; i < 500; ++i) {
    driveAbout(world);
    world.step();
  }
  World copy = world;
  for (int i = 0; i < 100; ++i) {
    driveAbout(world);
    world.step();
  }
  EXPECT_NE(copy.digest(), world.digest());
  for (int i = 0; i < 100; ++i) {
    driveAbout(copy);
    copy.step();
  }
  EXPECT_EQ(copy.digest(), world.digest());
  world.reset(3);
  EXPECT_EQ(world.time(), 0.0);
  World fresh(busyRoom(), room(), 3);
  EXPECT_EQ(world.digest(), fresh.digest());
  for (int i = 0; i < 200; ++i) {
    world.step();
    fresh.step();
  }
  EXPECT_EQ(world.digest(), fresh.digest());
}

TEST(World, nobodyEntersAWall) {
  const auto map = room();
  World world(busyRoom(), map, 11);
  for (int i = 0; i < 12000; ++i) {
    driveAbout(world);
    world.step();
    ASSERT_TRUE(map->discFree(world.robotPose().position(), world.base().params().hull_radius)) << i;
    for (const PersonState& person : world.people()) {
      ASSERT_TRUE(map->discFree(person.position, person.radius - 1e-6)) << person.name << " at step " << i;
    }
  }
}

TEST(World, robotReachesWhereItsTwistLeads) {
  Scenario scenario;
  scenario.robot_pose = {1.0, 2.0, 0.5};
  World world(scenario, nullptr, 1, KobukiParams::ideal());
  sarn::Pose2D integrated = scenario.robot_pose;
  for (int i = 0; i < 1000; ++i) {
    driveAbout(world);
    world.step();
    integrated = sarn::advance(integrated, world.robotTwist(), world.timeStep());
  }
  EXPECT_NEAR(world.robotPose().x, integrated.x, 1e-9);
  EXPECT_NEAR(world.robotPose().y, integrated.y, 1e-9);
  EXPECT_NEAR(world.robotPose().theta, integrated.theta, 1e-9);
  EXPECT_NEAR(world.time(), 10.0, 1e-9);
}

TEST(World, drivingIntoAWallIsOneContactThatPressesTheBumper) {
  const auto map = room();
  Scenario scenario;
  scenario.robot_pose = {9.0, 1.0, 0.0};
  World world(scenario, map, 1, KobukiParams::ideal());
  std::vector<Contact> contacts;
  for (int i = 0; i < 500; ++i) {
    world.base().commandVelocity(0.4, 0.0);
    world.step();
    contacts.insert(contacts.end(), world.newContacts().begin(), world.newContacts().end());
  }
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].other, "wall");
  EXPECT_NEAR(contacts[0].robot_closing_speed, 0.4, 1e-6);
  EXPECT_NEAR(contacts[0].point.x(), 9.8, 1e-2);
  EXPECT_EQ(world.base().packet().bumper, kCentreBit);
  EXPECT_NEAR(world.robotPose().x, 9.8 - world.base().params().hull_radius, 1e-6);
}

TEST(World, walkingIntoAStandingRobotIsAContactOfThePersonNotOfTheRobot) {
  Scenario scenario;
  PersonSpec person;
  person.name = "anna";
  person.model = PersonModel::kScripted;
  person.position = {3.0, 0.0};
  person.waypoints = {{-3.0, 0.0}};
  person.on_arrival = OnArrival::kStop;
  scenario.people = {person};
  World world(scenario, nullptr, 1, KobukiParams::ideal());
  std::vector<Contact> contacts;
  for (int i = 0; i < 800; ++i) {
    world.step();
    contacts.insert(contacts.end(), world.newContacts().begin(), world.newContacts().end());
  }
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].other, "anna");
  EXPECT_EQ(contacts[0].robot_closing_speed, 0.0);
  EXPECT_NEAR(contacts[0].other_closing_speed, 1.0, 1e-6);
  EXPECT_NEAR(contacts[0].standing_time, contacts[0].time, 1e-9);
  EXPECT_EQ(world.robotPose().x, 0.0);  // nobody pushes it
}

TEST(World, startsInWallsAreErrorsThatNameTheKey) {
  Scenario scenario = busyRoom();
  scenario.robot_pose = {0.1, 0.1, 0.0};
  try {
    World(scenario, room(), 1);
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("busy_room.yaml: robot.pose"), std::string::npos)
        << error.what();
  }
  scenario = busyRoom();
  scenario.people[4].position = {0.0, 5.0};
  try {
    World(scenario, room(), 1);
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("people[4].position"), std::string::npos) << error.what();
  }
}

TEST(World, jitterNeverPutsAnybodyIntoOrBehindAWall) {
  Scenario scenario;
  scenario.source = "s.yaml";
  scenario.robot_pose = {5.0, 5.0, 0.0};
  PersonSpec person;
  person.name = "anna";
  person.position = {0.5, 0.5};  // in a corner
  person.waypoints = {{5.0, 2.0}};
  scenario.people = {person};
  scenario.jitter.position = 0.8;
  const auto map = room();
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const World world(scenario, map, seed);
    const Eigen::Vector2d start = world.scenario().people[0].position;
    EXPECT_TRUE(map->discFree(start, person.radius));
    EXPECT_TRUE(map->segmentFree(person.position, start));
  }
}

}  // namespace
}  // namespace kobuki_sim
