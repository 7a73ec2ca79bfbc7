// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/crowd.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "drawn_map.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kStep = 0.01;  // [s]
const RobotDisc kNoRobot{{1e4, 1e4}, Vector2d::Zero(), 0.175};

PersonSpec personNamed(const std::string& name, PersonModel model, const Vector2d& position,
                       const std::vector<Vector2d>& waypoints = {}, OnArrival on_arrival = OnArrival::kStop) {
  PersonSpec spec;
  spec.name = name;
  spec.model = model;
  spec.position = position;
  spec.waypoints = waypoints;
  spec.on_arrival = on_arrival;
  return spec;
}

Scenario scenarioOf(const std::vector<PersonSpec>& people) {
  Scenario scenario;
  scenario.people = people;
  return scenario;
}

double leastGap(const std::vector<PersonState>& people) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!people[i].present || !people[j].present) continue;
      least = std::min(
          least, (people[i].position - people[j].position).norm() - people[i].radius - people[j].radius);
    }
  }
  return least;
}

double leastClearance(const StaticMap& map, const std::vector<PersonState>& people) {
  double least = std::numeric_limits<double>::infinity();
  for (const PersonState& person : people) {
    const auto wall = map.nearestWall(person.position, 2.0);
    if (wall) least = std::min(least, wall->distance - person.radius);
  }
  return least;
}

class BothModels : public ::testing::TestWithParam<PersonModel> {};
INSTANTIATE_TEST_SUITE_P(People, BothModels,
                         ::testing::Values(PersonModel::kOrca, PersonModel::kSocialForce));

TEST_P(BothModels, walkAtThePreferredSpeedToTheirWaypointAndStay) {
  Crowd crowd(scenarioOf({personNamed("anna", GetParam(), {0.0, 0.0}, {{4.0, 0.0}, {4.0, 3.0}})}), nullptr,
              1);
  double fastest = 0.0;
  for (int k = 0; k < 1500; ++k) {
    crowd.step(kStep, kNoRobot);
    fastest = std::max(fastest, crowd.people()[0].velocity.norm());
    if (k == 200) {
      EXPECT_NEAR(crowd.people()[0].position.x(), 1.8, 0.5);
    }
  }
  EXPECT_NEAR(fastest, 1.0, 0.05);
  EXPECT_LT((crowd.people()[0].position - Vector2d(4.0, 3.0)).norm(), 0.15);
  EXPECT_LT(crowd.people()[0].velocity.norm(), 0.05);
}

TEST_P(BothModels, twoHeadOnPassWithoutTouchingOnTheirRight) {
  Crowd crowd(scenarioOf({personNamed("anna", GetParam(), {-4.0, 0.0}, {{4.0, 0.0}}),
                          personNamed("ben", GetParam(), {4.0, 0.0}, {{-4.0, 0.0}})}),
              nullptr, 1);
  double least = 1e9;
  for (int k = 0; k < 1500; ++k) {
    const double before = crowd.people()[0].position.x() - crowd.people()[1].position.x();
    crowd.step(kStep, kNoRobot);
    least = std::min(least, leastGap(crowd.people()));
    const double after = crowd.people()[0].position.x() - crowd.people()[1].position.x();
    // Anna walks along x: on her right is the smaller y.
    if (before < 0.0 && after >= 0.0) {
      EXPECT_LT(crowd.people()[0].position.y(), crowd.people()[1].position.y());
    }
  }
  EXPECT_GT(least, 0.0);
  EXPECT_LT((crowd.people()[0].position - Vector2d(4.0, 0.0)).norm(), 0.15);
  EXPECT_LT((crowd.people()[1].position - Vector2d(-4.0, 0.0)).norm(), 0.15);
}

TEST_P(BothModels, twentyCrossACircle) {
  std::vector<PersonSpec> people;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.0 * sarn::kPi * i / 20;
    const Vector2d start = 6.0 * Vector2d(std::cos(angle), std::sin(angle));
    people.push_back(personNamed("p" + std::to_string(i), GetParam(), start, {-start}));
  }
  Crowd crowd(scenarioOf(people), nullptr, 1);
  double least = 1e9;
  for (int k = 0; k < 6000; ++k) {
    crowd.step(kStep, kNoRobot);
    least = std::min(least, leastGap(crowd.people()));
  }
  // Bodies may touch in the crush, not overlap.
  EXPECT_GT(least, -0.02);
  for (std::size_t i = 0; i < people.size(); ++i) {
    EXPECT_LT((crowd.people()[i].position - people[i].waypoints[0]).norm(), 0.3) << people[i].name;
  }
}

TEST_P(BothModels, doNotTouchARobotThatStandsInTheirWay) {
  Crowd crowd(scenarioOf({personNamed("anna", GetParam(), {-4.0, 0.0}, {{4.0, 0.0}})}), nullptr, 1);
  const RobotDisc robot{{0.0, 0.0}, Vector2d::Zero(), 0.18};
  double least = 1e9;
  for (int k = 0; k < 1500; ++k) {
    crowd.step(kStep, robot);
    least = std::min(least, crowd.people()[0].position.norm() - 0.25 - 0.18);
  }
  EXPECT_GT(least, 0.02);
  EXPECT_NEAR(crowd.people()[0].position.x(), 4.0, 0.15);
}

TEST_P(BothModels, whoIgnoresTheRobotBumpsIntoItButDoesNotWalkThroughIt) {
  PersonSpec anna = personNamed("anna", GetParam(), {-2.0, 0.02}, {{4.0, 0.0}});
  anna.reacts_to_robot = false;
  Crowd crowd(scenarioOf({anna}), nullptr, 1);
  const RobotDisc robot{{0.0, 0.0}, Vector2d::Zero(), 0.18};
  double least = 1e9;
  for (int k = 0; k < 3000; ++k) {
    crowd.step(kStep, robot);
    least = std::min(least, crowd.people()[0].position.norm() - 0.25 - 0.18);
  }
  EXPECT_LE(least, 0.0);
  EXPECT_GT(least, -0.01);
}

StaticMap doorMap(int door_cells) {  // 12 m x 8 m with a wall across and a door in its middle
  std::vector<std::string> rows(80, std::string(120, '.'));
  for (int y = 0; y < 80; ++y) {
    auto& row = rows[static_cast<std::size_t>(y)];
    row[0] = row[119] = '#';
    if (y < 40 - door_cells / 2 || y >= 40 - door_cells / 2 + door_cells) row[60] = '#';
  }
  rows.front() = rows.back() = std::string(120, '#');
  return drawnMap(rows, 0.1);
}

std::vector<PersonSpec> twoStreams(PersonModel model, int each) {
  std::vector<PersonSpec> people;
  for (int i = 0; i < 2 * each; ++i) {
    const double y = 2.0 + 4.0 * (i / 2 + 0.5) / each;
    const Vector2d left(2.0, y);
    const Vector2d right(10.0, y);
    const bool from_left = i % 2 == 0;
    people.push_back(
        personNamed("p" + std::to_string(i), model, from_left ? left : right, {from_left ? right : left}));
  }
  return people;
}

TEST_P(BothModels, streamsFacingEachOtherAtADoorGetThrough) {
  for (const int door : {7, 9, 12}) {
    const StaticMap map = doorMap(door);
    Crowd crowd(scenarioOf(twoStreams(GetParam(), 3)), &map, 1);
    double least_clearance = 1e9;
    double least_gap = 1e9;
    for (int k = 0; k < 18000; ++k) {
      crowd.step(kStep, kNoRobot);
      least_clearance = std::min(least_clearance, leastClearance(map, crowd.people()));
      least_gap = std::min(least_gap, leastGap(crowd.people()));
    }
    EXPECT_GE(least_clearance, -1e-6);
    EXPECT_GT(least_gap, -0.04);
    for (const PersonState& person : crowd.people()) {
      EXPECT_EQ(person.position.x() > 6.0, person.id % 2 == 0) << person.name << ", door of " << door;
    }
  }
}

TEST_P(BothModels, aPushingCrowdNeverEntersAWall) {
  // Forty people who all want to the same corner of a small room with a thin wall in it.
  std::vector<std::string> rows(40, std::string(60, '.'));
  rows.front() = rows.back() = std::string(60, '#');
  for (auto& row : rows) row.front() = row.back() = '#';
  for (std::size_t y = 10; y < 40; ++y) rows[y][30] = '#';
  const StaticMap map = drawnMap(rows, 0.1);
  std::vector<PersonSpec> people;
  for (int i = 0; i < 40; ++i) {
    people.push_back(personNamed("p" + std::to_string(i), GetParam(),
                                 {0.5 + 0.55 * (i % 5), 0.5 + 0.42 * (i / 5)}, {{5.5, 0.4}}));
    people.back().radius = 0.2;
  }
  Crowd crowd(scenarioOf(people), &map, 3);
  for (int k = 0; k < 4000; ++k) {
    std::vector<Vector2d> before;
    for (const PersonState& person : crowd.people()) before.push_back(person.position);
    crowd.step(kStep, kNoRobot);
    ASSERT_GE(leastClearance(map, crowd.people()), -1e-6) << "step " << k;
    for (const PersonState& person : crowd.people()) {
      ASSERT_TRUE(map.segmentFree(before[static_cast<std::size_t>(person.id)], person.position));
    }
  }
  int around_the_wall = 0;
  for (const PersonState& person : crowd.people()) around_the_wall += person.position.x() > 3.1 ? 1 : 0;
  EXPECT_GT(around_the_wall, 20);
}

TEST_P(BothModels, answerTurnsWithTheWorld) {
  const auto run = [](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    std::vector<PersonSpec> people;
    for (int i = 0; i < 6; ++i) {
      const Vector2d start(-3.0 + 0.1 * i, 1.1 * i - 3.0);
      const Vector2d goal(3.0, 3.0 - 0.9 * i);
      people.push_back(personNamed("p" + std::to_string(i), GetParam(), turn * start, {turn * goal}));
    }
    Crowd crowd(scenarioOf(people), nullptr, 1);
    const RobotDisc robot{turn * Vector2d(0.5, 0.2), turn * Vector2d(-0.2, 0.0), 0.18};
    for (int k = 0; k < 300; ++k) crowd.step(kStep, robot);
    std::vector<Vector2d> places;
    for (const PersonState& person : crowd.people()) places.push_back(turn.inverse() * person.position);
    return places;
  };
  const auto expected = run(0.0);
  for (const double angle : {0.7, 2.0, -1.3}) {
    const auto turned = run(angle);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LT((turned[i] - expected[i]).norm(), 1e-6);
  }
}

TEST_P(BothModels, walkAroundSomebodyWhoStandsBesideAWall) {
  const StaticMap map = drawnMap({"####################", "....................", "....................",
                                  "....................", "....................", "####################"},
                                 0.5);
  // Between ben and the wall is a pocket of 0.45 m.
  Crowd crowd(scenarioOf({personNamed("anna", GetParam(), {1.0, 2.2}, {{9.0, 2.2}}),
                          personNamed("ben", PersonModel::kStanding, {5.0, 1.8})}),
              &map, 1);
  double least = 1e9;
  for (int k = 0; k < 1500; ++k) {
    crowd.step(kStep, kNoRobot);
    least = std::min(least, leastGap(crowd.people()));
  }
  EXPECT_GT(least, 0.0);
  EXPECT_GT(crowd.people()[0].position.x(), 8.5);
  EXPECT_EQ(crowd.people()[1].position, Vector2d(5.0, 1.8));
}

std::vector<Vector2d> statesOf(const Crowd& crowd) {
  std::vector<Vector2d> states;
  for (const PersonState& person : crowd.people()) {
    states.push_back(person.position);
    states.push_back(person.velocity);
    states.push_back({person.heading, person.walking_phase});
  }
  return states;
}

TEST(Crowd, sameSeedIsTheSameToTheBitAndAnotherIsNot) {
  const StaticMap map = doorMap(9);
  const auto people = twoStreams(PersonModel::kOrca, 4);
  Crowd a(scenarioOf(people), &map, 7);
  Crowd b(scenarioOf(people), &map, 7);
  Crowd c(scenarioOf(people), &map, 8);
  for (int k = 0; k < 2000; ++k) {
    a.step(kStep, kNoRobot);
    b.step(kStep, kNoRobot);
    c.step(kStep, kNoRobot);
  }
  EXPECT_EQ(statesOf(a), statesOf(b));
  EXPECT_NE(statesOf(a), statesOf(c));
}

TEST(Crowd, aCopyGoesOnLikeTheOriginal) {
  const StaticMap map = doorMap(9);
  Crowd original(scenarioOf(twoStreams(PersonModel::kOrca, 3)), &map, 7);
  for (int k = 0; k < 505; ++k) original.step(kStep, kNoRobot);
  Crowd copy = original;
  for (int k = 0; k < 500; ++k) copy.step(kStep, kNoRobot);
  for (int k = 0; k < 500; ++k) original.step(kStep, kNoRobot);
  EXPECT_EQ(statesOf(copy), statesOf(original));
}

TEST(Crowd, longStepsAreManyShortOnes) {
  const auto people = twoStreams(PersonModel::kOrca, 2);
  Crowd fine(scenarioOf(people), nullptr, 1);
  Crowd coarse(scenarioOf(people), nullptr, 1);
  for (int k = 0; k < 500; ++k) fine.step(kStep, kNoRobot);
  for (int k = 0; k < 20; ++k) coarse.step(0.25, kNoRobot);
  for (std::size_t i = 0; i < people.size(); ++i) {
    EXPECT_LT((fine.people()[i].position - coarse.people()[i].position).norm(), 1e-6);
  }
}

TEST(Crowd, scriptedPeopleKeepTheirTimetableWhateverStandsInTheirWay) {
  PersonSpec anna = personNamed("anna", PersonModel::kScripted, {0.0, 0.0}, {{5.0, 0.0}});
  anna.start_time = 1.0;
  anna.preferred_speed = 0.8;
  Crowd crowd(scenarioOf({anna, personNamed("ben", PersonModel::kOrca, {2.0, 0.1})}), nullptr, 1);
  for (int k = 0; k < 350; ++k) crowd.step(kStep, {{1.5, 0.0}, Vector2d::Zero(), 0.18});
  EXPECT_NEAR(crowd.people()[0].position.x(), 0.8 * 2.5, 1e-6);
  EXPECT_EQ(crowd.people()[0].position.y(), 0.0);
  EXPECT_GT(leastGap(crowd.people()), -0.05);  // ben stepped aside
}

TEST(Crowd, peopleStandUntilTheirStartTime) {
  PersonSpec anna = personNamed("anna", PersonModel::kOrca, {0.0, 0.0}, {{5.0, 0.0}});
  anna.start_time = 2.0;
  Crowd crowd(scenarioOf({anna}), nullptr, 1);
  for (int k = 0; k < 195; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_EQ(crowd.people()[0].position, Vector2d(0.0, 0.0));
  for (int k = 0; k < 200; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_GT(crowd.people()[0].position.x(), 1.5);
}

TEST(Crowd, standingPeopleFaceTheirHeading) {
  PersonSpec anna = personNamed("anna", PersonModel::kStanding, {1.0, 2.0});
  anna.heading = 2.5;
  Crowd crowd(scenarioOf({anna}), nullptr, 1);
  for (int k = 0; k < 100; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_EQ(crowd.people()[0].position, Vector2d(1.0, 2.0));
  EXPECT_EQ(crowd.people()[0].heading, 2.5);
  EXPECT_EQ(crowd.people()[0].walking_phase, 0.0);
}

TEST(Crowd, legsMoveWithTheDistanceWalked) {
  PersonSpec anna = personNamed("anna", PersonModel::kScripted, {0.0, 0.0}, {{50.0, 0.0}});
  anna.preferred_speed = 1.3;  // 0.7 m a step, 1.4 m a cycle
  Crowd crowd(scenarioOf({anna}), nullptr, 1);
  for (int k = 0; k < 350; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_NEAR(crowd.people()[0].walking_phase, std::fmod(2.0 * sarn::kPi * 4.55 / 1.4, 2.0 * sarn::kPi),
              1e-6);
}

TEST(Crowd, respawnedPeopleComeBackOnlyWhenTheirPlaceIsFree) {
  Crowd crowd(
      scenarioOf({personNamed("anna", PersonModel::kOrca, {0.0, 0.0}, {{2.0, 0.0}}, OnArrival::kRespawn)}),
      nullptr, 1);
  RobotDisc robot{{0.0, 1e4}, Vector2d::Zero(), 0.18};
  bool was_away = false;
  for (int k = 0; k < 1000; ++k) {
    if (k == 100) robot.position = {0.0, 0.0};  // the robot takes her place meanwhile
    crowd.step(kStep, robot);
    was_away = was_away || !crowd.people()[0].present;
  }
  EXPECT_TRUE(was_away);
  EXPECT_FALSE(crowd.people()[0].present);
  robot.position = {0.0, 1e4};
  for (int k = 0; k < 20; ++k) crowd.step(kStep, robot);
  EXPECT_TRUE(crowd.people()[0].present);
  EXPECT_LT(crowd.people()[0].position.norm(), 0.5);
}

TEST_P(BothModels, groupsStayTogether) {
  const auto spread = [](const std::string& group) {
    std::vector<PersonSpec> people;
    for (int i = 0; i < 3; ++i) {
      people.push_back(personNamed("p" + std::to_string(i), GetParam(), {0.0, 0.7 * i}, {{25.0, 0.7 * i}}));
      people.back().preferred_speed = 0.8 + 0.2 * i;
      people.back().group = group;
    }
    Crowd crowd(scenarioOf(people), nullptr, 1);
    for (int k = 0; k < 1500; ++k) crowd.step(kStep, kNoRobot);
    double low = 1e9;
    double high = -1e9;
    for (const PersonState& person : crowd.people()) {
      low = std::min(low, person.position.x());
      high = std::max(high, person.position.x());
    }
    return high - low;
  };
  EXPECT_GT(spread(""), 4.0);
  EXPECT_LT(spread("friends"), 2.5);
}

TEST(Crowd, replayedPeopleAppearAndLeave) {
  const auto file = std::filesystem::temp_directory_path() / "crowd_test_replay.txt";
  std::ofstream(file) << "0 1 0 0\n25 1 1 0\n25 2 5 5\n50 2 5 6\n";
  PersonSpec spec = personNamed("crowd", PersonModel::kReplay, {0.0, 0.0});
  spec.file = file;
  Crowd crowd(scenarioOf({spec}), nullptr, 1);
  ASSERT_EQ(crowd.people().size(), 2U);
  EXPECT_EQ(crowd.people()[0].name, "crowd_1");
  EXPECT_TRUE(crowd.people()[0].present);
  EXPECT_FALSE(crowd.people()[1].present);
  for (int k = 0; k < 50; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_NEAR(crowd.people()[0].position.x(), 0.5, 1e-9);
  EXPECT_NEAR(crowd.people()[0].velocity.x(), 1.0, 1e-9);
  for (int k = 0; k < 100; ++k) crowd.step(kStep, kNoRobot);
  EXPECT_FALSE(crowd.people()[0].present);
  EXPECT_TRUE(crowd.people()[1].present);
  EXPECT_NEAR(crowd.people()[1].heading, 0.5 * sarn::kPi, 1e-6);
}

std::string errorOf(const Scenario& scenario, const StaticMap& map) {
  try {
    const Crowd crowd(scenario, &map, 1);
  } catch (const CrowdError& error) {
    return error.what();
  }
  return "";
}

TEST(Crowd, saysWhoCannotBePlacedOrSent) {
  std::vector<std::string> rows(20, std::string(60, '#'));
  for (std::size_t y = 5; y < 15; ++y) {
    for (std::size_t x = 5; x < 55; ++x) rows[y][x] = x == 30 ? '#' : '.';
  }
  const StaticMap map = drawnMap(rows, 0.1);
  EXPECT_NE(errorOf(scenarioOf({personNamed("anna", PersonModel::kOrca, {0.2, 1.9}, {{2.0, 1.0}})}), map)
                .find("anna: the position (0.2"),
            std::string::npos);
  EXPECT_NE(errorOf(scenarioOf({personNamed("ben", PersonModel::kOrca, {1.0, 1.0}, {{5.0, 1.0}})}), map)
                .find("ben: there is no way"),
            std::string::npos);
  // A little too near to a wall is moved off it.
  EXPECT_EQ(errorOf(scenarioOf({personNamed("clara", PersonModel::kOrca, {0.6, 1.0}, {{2.0, 1.0}})}), map),
            "");
}

TEST(Crowd, refusesAStepThatIsNone) {
  Crowd crowd(scenarioOf({}), nullptr, 1);
  EXPECT_THROW(crowd.step(0.0, kNoRobot), std::invalid_argument);
  EXPECT_THROW(crowd.step(std::nan(""), kNoRobot), std::invalid_argument);
}

}  // namespace
}  // namespace kobuki_sim
