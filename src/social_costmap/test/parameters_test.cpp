// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "social_costmap/timed_costmap.h"

namespace social_costmap {
namespace {

template <class P>
void expectShipped(const YAML::Node& node, const char* group) {
  std::set<std::string> keys;
  for (const auto& entry : node) keys.insert(entry.first.as<std::string>());
  const auto names = sarn::fieldNames<P>();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), keys) << group;
  P params;
  for (const auto& problem : sarn::setFromYaml(node, params)) ADD_FAILURE() << group << ": " << problem;
  EXPECT_TRUE(sarn::problems(P{}).empty()) << group;
}

TEST(Parameters, shippedYamlNamesEveryFieldAndHasNoProblems) {
  const YAML::Node config = YAML::LoadFile("config/costmap.yaml");
  ASSERT_EQ(4U, config.size());
  expectShipped<StaticLayerParams>(config["static"], "static");
  expectShipped<ObstacleLayerParams>(config["obstacle"], "obstacle");
  expectShipped<InflationLayerParams>(config["inflation"], "inflation");
  expectShipped<SocialParams>(config["social"], "social");
}

TEST(Core, includesNoRos) {
  const std::regex ros("#include [<\"](ros/|tf|[a-z_]+_msgs/|pluginlib|dynamic_reconfigure)");
  for (const char* folder : {"include", "src"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      EXPECT_FALSE(std::regex_search(text, ros)) << entry.path();
    }
  }
}

}  // namespace
}  // namespace social_costmap
