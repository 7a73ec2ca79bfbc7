// SPDX-License-Identifier: BSD-3-Clause
// The shipped YAML files are fixtures: their keys are the structs' fields, and they have no problems.
#include "sarn_common/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sarn_perception/depth_to_scan_params.h"
#include "sarn_perception/fake_detection_params.h"
#include "sarn_perception/people_tracker_params.h"
#include "sarn_perception/prediction_params.h"
#include "sarn_perception/tracking_params.h"

namespace sarn_perception {
namespace {

template <class P>
void expectFixture(const YAML::Node& node, const std::string& file) {
  P params;
  EXPECT_EQ(sarn::setFromYaml(node, params), std::vector<std::string>{});
  std::vector<std::string> keys;
  for (const auto& entry : node) keys.push_back(entry.first.as<std::string>());
  EXPECT_EQ(keys, sarn::fieldNames<P>()) << file;
}

template <class P>
void expectFixture(const std::string& file) {
  expectFixture<P>(YAML::LoadFile(file), file);
}

TEST(Parameters, shippedTrackerFilesNameEveryField) {
  YAML::Node file = YAML::LoadFile("config/people_tracker.yaml");
  expectFixture<BackgroundParams>(file["background"], "background");
  expectFixture<LegParams>(file["legs"], "legs");
  expectFixture<BodyParams>(file["bodies"], "bodies");
  expectFixture<TrackerParams>(file["tracker"], "tracker");
  for (const char* section : {"background", "legs", "bodies", "tracker"}) file.remove(section);
  expectFixture<PeopleTrackerParams>(file, "people_tracker.yaml");
  const YAML::Node lidar = YAML::LoadFile("config/people_tracker_lidar.yaml");
  EXPECT_EQ(lidar.size(), 2U);
  EXPECT_FALSE(lidar["use_bodies"].as<bool>());
  expectFixture<LegParams>(lidar["legs"], "people_tracker_lidar.yaml");
}

TEST(Parameters, shippedFilesNameEveryField) {
  expectFixture<DepthToScanParams>("config/depthimage_to_laserscan.yaml");
  expectFixture<FakeDetectionParams>("config/fake_detection.yaml");
  expectFixture<PredictionParams>("config/constant_velocity_prediction.yaml");
}

TEST(Parameters, defaultsAreValid) {
  EXPECT_TRUE(sarn::problems(DepthToScanParams{}).empty());
  EXPECT_TRUE(sarn::problems(FakeDetectionParams{}).empty());
  EXPECT_TRUE(sarn::problems(PredictionParams{}).empty());
  EXPECT_TRUE(sarn::problems(BackgroundParams{}).empty());
  EXPECT_TRUE(sarn::problems(LegParams{}).empty());
  EXPECT_TRUE(sarn::problems(BodyParams{}).empty());
  EXPECT_TRUE(sarn::problems(TrackerParams{}).empty());
  EXPECT_TRUE(sarn::problems(PeopleTrackerParams{}).empty());
}

TEST(Parameters, nameConflicts) {
  DepthToScanParams depth;
  depth.out_of_range_policy = "zero";
  depth.range_min = 11.0;
  EXPECT_EQ(sarn::problems(depth).size(), 3U);  // range, conflict of the ranges, policy
  PredictionParams prediction;
  prediction.walls = "jump";
  EXPECT_EQ(sarn::problems(prediction),
            (std::vector<std::string>{"walls: 'jump' must be stop, slide or ignore"}));
  TrackerParams tracker;
  tracker.report_existence = 0.9;
  tracker.standing_density = 1.0;
  EXPECT_EQ(sarn::problems(tracker).size(), 2U);
  LegParams legs;
  legs.max_width = 0.8;
  EXPECT_EQ(sarn::problems(legs).size(), 1U);
  PeopleTrackerParams node;
  node.odom_frame.clear();
  EXPECT_EQ(sarn::problems(node), (std::vector<std::string>{"odom_frame: must not be empty"}));
}

}  // namespace
}  // namespace sarn_perception
