// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "sarn_navigation_ros/navigator_parameters.h"

namespace sarn_navigation {
namespace {

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> keys(const YAML::Node& node) {
  std::vector<std::string> names;
  for (const auto& entry : node) {
    if (!entry.second.IsMap()) names.push_back(entry.first.as<std::string>());
  }
  return sorted(names);
}

TEST(NavigatorYaml, holdsEveryFieldAndNothingElse) {
  const YAML::Node yaml = YAML::LoadFile("config/navigator.yaml");
  EXPECT_EQ(keys(yaml), sorted(sarn::fieldNames<NavigatorNodeParams>()));
  EXPECT_EQ(keys(yaml["navigator"]), sorted(sarn::fieldNames<NavigatorParams>()));
  NavigatorParams params;
  EXPECT_TRUE(sarn::setFromYaml(yaml["navigator"], params).empty());
}

TEST(NavigatorParams, namesEachConflict) {
  NavigatorParams params;
  params.release_delay = 0.1;
  EXPECT_EQ(sarn::problems(params).size(), 1U);
  NavigatorNodeParams node;
  node.social = "sometimes";
  EXPECT_EQ(sarn::problems(node).size(), 1U);
}

}  // namespace
}  // namespace sarn_navigation
