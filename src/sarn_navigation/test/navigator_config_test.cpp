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

TEST(NavigatorConfig, costsAreInflatedByTheFootprintsInscribedRadius) {
  NavigatorConfig config;
  const double before = config.costmap.inflation_layer.inscribed_radius;
  inflateByFootprint(config);
  EXPECT_DOUBLE_EQ(config.costmap.inflation_layer.inscribed_radius, before) << "round: as the costmap says";
  config.planner.footprint = "[[0.5, 0.15], [-0.5, 0.15], [-0.5, -0.15], [0.5, -0.15]]";
  inflateByFootprint(config);
  EXPECT_DOUBLE_EQ(config.costmap.inflation_layer.inscribed_radius, 0.15);
  EXPECT_TRUE(sarn::problems(config.costmap.inflation_layer).empty());
}

/// A shipped YAML of a package beside this one.
template <class Params>
Params shipped(const char* file) {
  Params params;
  EXPECT_TRUE(sarn::setFromYaml(YAML::LoadFile(file), params).empty()) << file;
  return params;
}

// A follower that may do less than the plan asks for lags behind; one that may do much more is not what was
// planned.
TEST(ShippedYaml, followerCanDriveWhatThePlannerPlans) {
  const auto planner =
      shipped<lattice_planner::PlannerParams>("../lattice_planner/config/lattice_planner.yaml");
  const auto follower =
      shipped<timed_path_follower::FollowerParams>("../timed_path_follower/config/timed_path_follower.yaml");
  EXPECT_GE(follower.max_vel_x, planner.max_vel_x);
  EXPECT_LE(follower.max_vel_x, 1.5 * planner.max_vel_x);
  EXPECT_GE(follower.max_vel_theta, planner.max_vel_theta);
  EXPECT_LE(follower.max_vel_theta, 1.5 * planner.max_vel_theta);
  EXPECT_GE(follower.acc_lim_x, planner.acc_lim_x);
  EXPECT_GE(follower.acc_lim_theta, planner.acc_lim_theta);
  EXPECT_GE(follower.xy_goal_tolerance, planner.xy_goal_tolerance);
  EXPECT_GE(follower.yaw_goal_tolerance, planner.yaw_goal_tolerance);
}

// Predicted steps that no layer shows would be lost; what layers show beyond them moves on, less certain.
TEST(ShippedYaml, layersShowEverythingThatIsPredicted) {
  const YAML::Node predictor = YAML::LoadFile("../sarn_perception/config/constant_velocity_prediction.yaml");
  const double predicted = predictor["time_step"].as<double>() * predictor["num_predictions"].as<double>();
  const YAML::Node social = YAML::LoadFile("../social_costmap/config/costmap.yaml")["social"];
  const double shown = social["layer_duration"].as<double>() * social["num_layers"].as<double>();
  EXPECT_GE(shown, predicted);
  EXPECT_DOUBLE_EQ(social["layer_duration"].as<double>(), predictor["time_step"].as<double>());
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
