// SPDX-License-Identifier: BSD-3-Clause
// The shipped YAML of each node names exactly the fields of its parameter struct, has no problem, and holds
// the defaults.
#include <gtest/gtest.h>

#include <algorithm>

#include "sarn_common/parameters.h"
#include "sarn_navigation/safety_controller.h"
#include "sarn_navigation/velocity_smoother.h"
#include "sarn_navigation_ros/parameters.h"

namespace sarn_navigation {
namespace {

template <class P>
void expectComplete(const std::string& path) {
  const YAML::Node node = YAML::LoadFile(path);
  P params;
  EXPECT_TRUE(sarn::setFromYaml(node, params).empty()) << path;
  for (const auto& name : sarn::fieldNames<P>())
    EXPECT_TRUE(node[name]) << path << ": " << name << " is missing";
}

TEST(Config, namesEveryField) {
  expectComplete<VelocitySmootherParams>("config/velocity_smoother.yaml");
  expectComplete<SafetyControllerParams>("config/safety_controller.yaml");
  expectComplete<ScanBrakeNodeParams>("config/scan_brake.yaml");
}

TEST(Config, aBadValueAndAnUnknownKeyAreNamed) {
  ScanBrakeNodeParams params;
  const auto problems = sarn::setFromYaml(YAML::Load("{deceleration: 0, margn: 1}"), params);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_NE(problems[0].find("margn"), std::string::npos);
  EXPECT_NE(problems[1].find("deceleration"), std::string::npos);
}

}  // namespace
}  // namespace sarn_navigation
