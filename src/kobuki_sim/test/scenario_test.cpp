// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/scenario.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace kobuki_sim {
namespace {

const std::string kGood = R"(
name: crossing
map: none
time_limit: 60.0
robot: {pose: [1.0, 2.0, 0.5]}
goals: [[3.0, 4.0, 0.0], [5.0, 6.0, 7.0]]
people:
  - name: anna
    model: social_force
    position: [4.0, 2.0]
    waypoints: [[8.0, 2.0], [4.0, 2.0]]
    on_arrival: reverse
    start_time: 2.0
    preferred_speed: 0.9
    radius: 0.3
    reacts_to_robot: false
    group: friends
  - {name: bert, model: standing, position: [0, 5], heading: 1.5}
jitter: {position: 0.2, start_time: 1.0, preferred_speed: 0.1}
seed: 42
)";

/// The message of the error that a scenario text gives.
std::string errorOf(const std::string& yaml) {
  try {
    (void)parseScenario(yaml, "dir/s.yaml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expectError(const std::string& from, const std::string& to, const std::string& key,
                 const std::string& word) {
  const std::string error = errorOf(replaced(kGood, from, to));
  EXPECT_NE(error.find("dir/s.yaml"), std::string::npos) << error;
  EXPECT_NE(error.find(key), std::string::npos) << error;
  EXPECT_NE(error.find(word), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST(Scenario, readsEveryKey) {
  const Scenario s = parseScenario(kGood, "dir/s.yaml");
  EXPECT_EQ(s.name, "crossing");
  EXPECT_TRUE(s.map.empty());
  EXPECT_EQ(s.time_limit, 60.0);
  EXPECT_EQ(s.robot_pose.theta, 0.5);
  ASSERT_EQ(s.goals.size(), 2U);
  EXPECT_NEAR(s.goals[1].theta, 7.0 - 2.0 * sarn::kPi, 1e-12);
  ASSERT_EQ(s.people.size(), 2U);
  const PersonSpec& anna = s.people[0];
  EXPECT_EQ(anna.model, PersonModel::kSocialForce);
  EXPECT_EQ(anna.on_arrival, OnArrival::kReverse);
  EXPECT_EQ(anna.waypoints.at(0), Eigen::Vector2d(8.0, 2.0));
  EXPECT_EQ(anna.start_time, 2.0);
  EXPECT_EQ(anna.preferred_speed, 0.9);
  EXPECT_EQ(anna.radius, 0.3);
  EXPECT_FALSE(anna.reacts_to_robot);
  EXPECT_EQ(anna.group, "friends");
  EXPECT_FALSE(anna.heading);
  EXPECT_EQ(s.people[1].model, PersonModel::kStanding);
  EXPECT_EQ(s.people[1].heading, 1.5);
  EXPECT_EQ(s.jitter.start_time, 1.0);
  EXPECT_EQ(s.seed, 42U);
}

TEST(Scenario, errorsAreOneLineThatNamesFileAndKey) {
  expectError("radius: 0.3", "raduis: 0.3", "people[0].raduis", "unknown key");
  expectError("time_limit", "timelimit", "timelimit", "unknown key");
  expectError("robot: {pose: [1.0, 2.0, 0.5]}", "robot: {pose: [1.0, 2.0]}", "robot.pose", "[x, y, yaw]");
  expectError("robot: {pose: [1.0, 2.0, 0.5]}\n", "", "robot", "missing");
  expectError("[5.0, 6.0, 7.0]", "[5.0, .nan, 7.0]", "goals[1][1]", "finite");
  expectError("social_force", "socialforce", "people[0].model", "one of");
  expectError("on_arrival: reverse", "on_arrival: back", "people[0].on_arrival", "one of");
  expectError("start_time: 2.0", "start_time: soon", "people[0].start_time", "finite number");
  expectError("radius: 0.3", "radius: -0.3", "people[0].radius", "outside");
  expectError("reacts_to_robot: false", "reacts_to_robot: maybe", "people[0].reacts_to_robot",
              "true nor false");
  expectError("name: bert", "name: anna", "people[1].name", "taken");
  expectError("map: none", "map: nowhere.yaml", "map", "does not exist");
  expectError("seed: 42", "seed: -1", "seed", "whole number");
  expectError("seed: 42", "seed: 1.5", "seed", "whole number");
  expectError("waypoints: [[8.0, 2.0], [4.0, 2.0]]\n", "\n", "people[0].waypoints", "missing");
  expectError("model: standing", "model: replay", "people[1]", "unknown key");
  expectError("{name: bert, model: standing, position: [0, 5], heading: 1.5}", "{name: bert, model: replay}",
              "people[1].file", "missing");
  expectError("{position: 0.2, ", "{position: 0.2, speed: 1, ", "jitter.speed", "unknown key");
  expectError("name: crossing", "name: [", "", "not YAML");
  EXPECT_NE(errorOf("- a\n- b").find("not a map"), std::string::npos);
  EXPECT_NE(errorOf("").find("not a map"), std::string::npos);
  EXPECT_NE(errorOf(replaced(kGood, "radius: 0.3", "raduis: 0.3")).find("s.yaml:15:"), std::string::npos)
      << "the line of the unknown key";
}

TEST(Scenario, missingFileIsNamed) {
  try {
    (void)loadScenario("no/such/file.yaml");
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/file.yaml"), std::string::npos);
  }
}

TEST(Scenario, filesAreTakenRelativeToTheScenario) {
  const auto dir = std::filesystem::temp_directory_path() / "kobuki_sim_scenario_test";
  std::filesystem::create_directories(dir / "scenarios");
  std::ofstream(dir / "walk.txt") << "0 1 0.0 0.0\n";
  std::ofstream(dir / "scenarios" / "s.yaml") << "robot: {pose: [0, 0, 0]}\npeople: [{name: crowd, model: "
                                                 "replay, file: ../walk.txt, frame_rate: 2.5}]\n";
  const Scenario s = loadScenario(dir / "scenarios" / "s.yaml");
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.people.at(0).file, dir / "walk.txt");
  EXPECT_EQ(s.people.at(0).frame_rate, 2.5);
  std::filesystem::remove_all(dir);
}

TEST(ScenarioJitter, staysInItsBoundsAndLeavesStandingPeopleAlone) {
  const Scenario s = parseScenario(kGood);
  bool moved = false;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scenario drawn = jittered(s, seed);
    const PersonSpec& anna = drawn.people[0];
    EXPECT_LE((anna.position - s.people[0].position).cwiseAbs().maxCoeff(), 0.2);
    EXPECT_GE(anna.start_time, 2.0);
    EXPECT_LE(anna.start_time, 3.0);
    EXPECT_NEAR(anna.preferred_speed, 0.9, 0.1);
    moved = moved || anna.position != s.people[0].position;
    EXPECT_EQ(drawn.people[1].position, s.people[1].position);
  }
  EXPECT_TRUE(moved);
}

TEST(ScenarioJitter, isAFunctionOfTheSeedOnly) {
  const Scenario s = parseScenario(kGood);
  EXPECT_EQ(jittered(s, 5).people[0].position, jittered(s, 5).people[0].position);
  EXPECT_NE(jittered(s, 5).people[0].position, jittered(s, 6).people[0].position);
}

}  // namespace
}  // namespace kobuki_sim
