// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/parameters.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sarn_common_ros/parameter_reader.h"

namespace kobuki_sim {
namespace {

TEST(NodeParams, theShippedYamlNamesEveryFieldButTheScenario) {
  YAML::Node node = YAML::LoadFile("config/kobuki_sim.yaml");
  EXPECT_TRUE(node["lockstep"].IsSequence());
  node.remove("lockstep");
  NodeParams params;
  params.scenario = "office.yaml";
  EXPECT_EQ(sarn::setFromYaml(node, params), std::vector<std::string>{});
  for (const auto& name : sarn::fieldNames<NodeParams>()) {
    EXPECT_TRUE(name == "scenario" || node[name]) << name;
  }
}

TEST(LockstepParticipants, areNamesOrNamesWithTheirSlack) {
  EXPECT_EQ(parseParticipant("navigator", 0.06).name, "navigator");
  EXPECT_EQ(parseParticipant("navigator", 0.06).slack, 0.06);
  EXPECT_EQ(parseParticipant("people_tracker@0.16", 0.06).name, "people_tracker");
  EXPECT_EQ(parseParticipant("people_tracker@0.16", 0.06).slack, 0.16);
  for (const char* bad : {"", "@0.1", "a@", "a@x", "a@0.1s", "a@-1", "a@nan"}) {
    EXPECT_THROW(parseParticipant(bad, 0.06), sarn::ParameterError) << bad;
  }
}

TEST(NodeParams, theScenarioMustBeGiven) {
  const auto problems = sarn::problems(NodeParams{});
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].find("scenario"), 0U);
}

TEST(NodeParams, batteryLevelsMustGrow) {
  NodeParams params;
  params.scenario = "office.yaml";
  params.battery_low = 13.0;
  EXPECT_EQ(sarn::problems(params).size(), 1U);
}

}  // namespace
}  // namespace kobuki_sim
