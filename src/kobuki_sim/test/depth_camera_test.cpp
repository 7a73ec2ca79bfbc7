// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/depth_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drawn_map.h"
#include "sarn_common/angles.h"
#include "sarn_common/parameters.h"

namespace kobuki_sim {
namespace {

constexpr int kAxisRow = 235;  // 0.5 px above the optical axis

/// The camera at base_footprint's origin, without noise or losses.
DepthCameraParams exact() {
  DepthCameraParams params;
  params.mount_x = params.mount_y = 0.0;
  params.noise_scale = params.drop_probability = params.grazing_cos_none = params.grazing_cos_full = 0.0;
  params.disparity_steps = 0;
  params.shadows = false;
  return params;
}

/// A closed room of 8 m x 6 m (inside), its lower left inner corner at (0.5, 0.5).
StaticMap room() {
  std::vector<std::string> rows(14, "#................#");
  rows.front() = rows.back() = "##################";
  return drawnMap(rows, 0.5);
}

PersonState personAt(double x, double y, double heading, double speed, double phase) {
  PersonState person;
  person.position = {x, y};
  person.heading = heading;
  person.velocity = speed * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  person.walking_phase = phase;
  return person;
}

/// Runs of columns of a row whose depth lies in [nearest, farthest] mm.
int runs(const DepthImage& image, int row, int nearest, int farthest) {
  int count = 0;
  bool inside = false;
  for (int u = 0; u < image.width; ++u) {
    const bool hit = image.at(u, row) >= nearest && image.at(u, row) <= farthest;
    count += hit && !inside ? 1 : 0;
    inside = hit;
  }
  return count;
}

TEST(DepthCamera, seesAFlatWallAtItsDepthAlongTheAxis) {
  DepthCamera camera(exact(), 1);
  const DepthImage& image = camera.render(room(), {4.5, 3.5, 0.0}, {}, 0);
  ASSERT_EQ(image.millimetres.size(), 640U * 480U);
  for (const int u : {200, 314, 400}) EXPECT_EQ(image.at(u, kAxisRow), 4000) << u;
  // Column 639 looks 29.64 deg to the right and meets the end wall 4 m ahead, 2.28 m to the right.
  EXPECT_EQ(image.at(639, kAxisRow), 4000);
}

TEST(DepthCamera, seesTheFloorWhereItIs) {
  DepthCamera camera(exact(), 1);
  const DepthImage& image = camera.render(StaticMap(), {0.0, 0.0, 0.0}, {}, 0);
  const DepthCameraParams params;
  for (int v = 300; v < 480; ++v) {
    const double z = params.mount_z * params.fy / (v - params.cy);
    EXPECT_NEAR(image.at(320, v), 1000.0 * z, 1.0) << v;
  }
  for (int v = 0; v <= kAxisRow; ++v)
    EXPECT_EQ(image.at(320, v), 0) << "nothing above the horizon of open space";
}

TEST(DepthCamera, looksOverWallsAtTheirHeight) {
  DepthCameraParams params = exact();
  params.wall_height = 1.2972;  // one metre above the camera
  DepthCamera camera(params, 1);
  const DepthImage& image = camera.render(room(), {4.5, 3.5, 0.0}, {}, 0);
  // 4 m away its top is fy / 4 rows above the axis.
  const int top = static_cast<int>(std::ceil(params.cy - params.fy / 4.0));
  EXPECT_EQ(image.at(320, top), 4000);
  EXPECT_EQ(image.at(320, top - 1), 0);
}

TEST(DepthCamera, standsWhereItIsMounted) {
  DepthCameraParams params = exact();
  params.mount_x = -0.25;
  params.mount_y = 0.5;
  DepthCamera camera(params, 1);
  EXPECT_EQ(camera.render(room(), {4.5, 3.5, 0.0}, {}, 0).at(320, kAxisRow), 4250);
  EXPECT_EQ(camera.render(room(), {4.5, 3.5, sarn::kPi / 2.0}, {}, 0).at(320, kAxisRow), 3250);
}

TEST(DepthCamera, seesTheSameInATurnedWorld) {
  DepthCamera camera(exact(), 1);
  const std::vector<PersonState> people{personAt(6.0, 3.2, 0.4, 1.0, 1.1), personAt(7.0, 4.5, 2.0, 0.0, 0.0)};
  const std::vector<std::uint16_t> here = camera.render(StaticMap(), {4.0, 3.0, 0.2}, people, 0).millimetres;
  const sarn::Pose2D world{-3.0, 5.0, 2.2};
  std::vector<PersonState> turned = people;
  for (PersonState& person : turned) {
    person.position = world * person.position;
    person.heading += world.theta;
  }
  const auto& there = camera.render(StaticMap(), world * sarn::Pose2D{4.0, 3.0, 0.2}, turned, 0).millimetres;
  int different = 0;
  for (std::size_t i = 0; i < here.size(); ++i) different += std::abs(here[i] - there[i]) > 1 ? 1 : 0;
  EXPECT_LE(different, 30) << "only pixels on an outline may flip";
}

TEST(DepthCamera, seesTwoLegsATorsoAndAHead) {
  DepthCamera camera(exact(), 1);
  for (const double heading : {0.0, 0.5 * sarn::kPi, 2.5}) {
    for (const double phase : {0.5 * sarn::kPi, 4.5}) {
      // Seen from the side legs may hide each other between two steps; at mid-stride they are apart.
      const auto& image =
          camera.render(StaticMap(), {0.0, 0.0, 0.0}, {personAt(4.0, 0.0, heading, 1.2, phase)}, 0);
      EXPECT_EQ(runs(image, kAxisRow, 3000, 4500), 2) << "shins, heading " << heading;
      const DepthCameraParams params;
      const int chest = static_cast<int>(params.cy - params.fy * (1.3 - params.mount_z) / 4.0);
      const int head = static_cast<int>(params.cy - params.fy * (1.63 - params.mount_z) / 4.0);
      EXPECT_EQ(runs(image, chest, 3700, 4100), 1);
      EXPECT_EQ(runs(image, head, 3800, 4100), 1);
    }
  }
}

TEST(DepthCamera, seesLegsSwing) {
  DepthCamera camera(exact(), 1);
  const auto nearestShin = [&](double phase) {
    const auto& image = camera.render(StaticMap(), {0.0, 0.0, 0.0}, {personAt(4.0, 0.0, 0.0, 1.3, phase)}, 0);
    int nearest = 1 << 20;
    for (int u = 0; u < image.width; ++u) {
      if (image.at(u, kAxisRow) != 0) nearest = std::min<int>(nearest, image.at(u, kAxisRow));
    }
    return nearest;
  };
  const int apart = nearestShin(0.5 * sarn::kPi);
  const int together = nearestShin(0.0);
  EXPECT_GT(together - apart, 150) << "one leg is half a step nearer";
  EXPECT_EQ(nearestShin(1.5 * sarn::kPi), apart) << "then the other";
}

TEST(DepthCamera, hidesPeopleBehindWallsAndAbsentOnes) {
  DepthCamera camera(exact(), 1);
  const StaticMap map = room();
  const auto empty = camera.render(map, {4.5, 3.5, 0.0}, {}, 0).millimetres;
  PersonState absent = personAt(6.0, 3.5, 0.0, 0.0, 0.0);
  absent.present = false;
  EXPECT_EQ(camera.render(map, {4.5, 3.5, 0.0}, {absent, personAt(10.0, 3.5, 0.0, 0.0, 0.0)}, 0).millimetres,
            empty);
  EXPECT_EQ(camera.render(map, {4.5, 3.5, 0.0}, {personAt(2.0, 3.5, 0.0, 0.0, 0.0)}, 0).millimetres, empty)
      << "behind the camera";
}

TEST(DepthCamera, returnsNothingOutOfRange) {
  DepthCamera camera(exact(), 1);
  const StaticMap map = room();
  EXPECT_EQ(camera.render(map, {8.08, 3.5, 0.0}, {}, 0).at(320, kAxisRow), 0);   // 0.42 m
  EXPECT_EQ(camera.render(map, {8.0, 3.5, 0.0}, {}, 0).at(320, kAxisRow), 500);  // 0.5 m
  DepthCameraParams params = exact();
  params.range_max = 3.9;
  EXPECT_EQ(DepthCamera(params, 1).render(map, {4.5, 3.5, 0.0}, {}, 0).at(320, kAxisRow), 0);
}

TEST(DepthCamera, repeatsAnImageFromSeedAndFrame) {
  const StaticMap map = room();
  const std::vector<PersonState> people{personAt(6.5, 3.0, 1.0, 1.0, 0.3)};
  DepthCamera camera({}, 7);
  const auto third = camera.render(map, {4.5, 3.5, 0.1}, people, 3).millimetres;
  EXPECT_NE(camera.render(map, {4.5, 3.5, 0.1}, people, 4).millimetres, third);
  EXPECT_EQ(camera.render(map, {4.5, 3.5, 0.1}, people, 3).millimetres, third);
  EXPECT_EQ(DepthCamera({}, 7).render(map, {4.5, 3.5, 0.1}, people, 3).millimetres, third);
  EXPECT_NE(DepthCamera({}, 8).render(map, {4.5, 3.5, 0.1}, people, 3).millimetres, third);
}

TEST(DepthCameraParams, shippedFileNamesEveryField) {
  const YAML::Node node = YAML::LoadFile("config/depth_camera.yaml");
  DepthCameraParams params;
  EXPECT_EQ(sarn::setFromYaml(node, params), std::vector<std::string>{});
  std::vector<std::string> keys;
  for (const auto& entry : node) keys.push_back(entry.first.as<std::string>());
  EXPECT_EQ(keys, sarn::fieldNames<DepthCameraParams>());
}

TEST(DepthCamera, refusesParametersWithEveryProblem) {
  DepthCameraParams params;
  params.range_min = 20.0;
  params.mount_z = 2.8;
  try {
    DepthCamera camera(params, 1);
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("range_min"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("mount_z"), std::string::npos);
  }
}

}  // namespace
}  // namespace kobuki_sim
