// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/parameters.h"

#include <gtest/gtest.h>

#include "sarn_common/parameters.h"
#include "sarn_localization/localization_params.h"
#include "sarn_localization/slam_params.h"

namespace sarn_localization {
namespace {

template <class P>
void expectShippedYamlMatches(const std::string& file) {
  const YAML::Node node = YAML::LoadFile(file);
  P params;
  EXPECT_TRUE(sarn::setFromYaml(node, params).empty());
  for (const auto& name : sarn::fieldNames<P>()) EXPECT_TRUE(node[name]) << file << " lacks " << name;
}

TEST(Parameters, shippedYamlNamesEveryField) {
  expectShippedYamlMatches<MapServerParams>("config/map_server.yaml");
  expectShippedYamlMatches<TruthLocalizationParams>("config/truth_localization.yaml");
  expectShippedYamlMatches<LocalizationParams>("config/localization.yaml");
  expectShippedYamlMatches<SlamParams>("config/slam.yaml");
}

/// A file that is loaded over another one names some fields, with values that can be.
template <class P>
void expectOverlayMatches(const std::string& file) {
  P params;
  EXPECT_EQ(sarn::setFromYaml(YAML::LoadFile(file), params), std::vector<std::string>{}) << file;
}

TEST(Parameters, theLidarsFilesNameFields) {
  expectOverlayMatches<LocalizationParams>("config/localization_lidar.yaml");
  expectOverlayMatches<SlamParams>("config/slam_lidar.yaml");
}

TEST(Parameters, contradictionsOfLocalizationAreProblems) {
  EXPECT_TRUE(sarn::problems(LocalizationParams{}).empty());
  LocalizationParams params;
  params.odom_frame_id = params.base_frame_id;
  params.min_particles = params.max_particles + 1;
  params.laser_z_hit = 0.5;
  params.laser_min_range = params.laser_max_range;
  params.recovery_alpha_slow = params.recovery_alpha_fast;
  EXPECT_EQ(sarn::problems(params).size(), 5U);
}

TEST(Parameters, emptyAndEqualFramesAreProblems) {
  MapServerParams map;
  map.frame_id.clear();
  EXPECT_EQ(sarn::problems(map).size(), 1U);
  TruthLocalizationParams truth;
  truth.odom_frame_id = truth.global_frame_id;
  EXPECT_EQ(sarn::problems(truth).size(), 1U);
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
