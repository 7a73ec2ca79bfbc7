// SPDX-License-Identifier: BSD-3-Clause
// The shipped YAML files are fixtures: their keys are the structs' fields, and they have no problems.
#include "sarn_common/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sarn_perception/depth_to_scan_params.h"
#include "sarn_perception/fake_detection_params.h"
#include "sarn_perception/prediction_params.h"

namespace sarn_perception {
namespace {

template <class P>
void expectFixture(const std::string& file) {
  const YAML::Node node = YAML::LoadFile(file);
  P params;
  EXPECT_EQ(sarn::setFromYaml(node, params), std::vector<std::string>{});
  std::vector<std::string> keys;
  for (const auto& entry : node) keys.push_back(entry.first.as<std::string>());
  EXPECT_EQ(keys, sarn::fieldNames<P>()) << file;
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
}

}  // namespace
}  // namespace sarn_perception
