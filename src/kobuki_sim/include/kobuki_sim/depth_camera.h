// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/body_shape.h"
#include "kobuki_sim/depth_camera_params.h"
#include "kobuki_sim/depth_noise.h"
#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/slice_view.h"
#include "kobuki_sim/static_map.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// Row-major depth along the optical axis [mm]; 0: no return.
struct DepthImage {
  int width = 0;   // [px]
  int height = 0;  // [px]
  std::vector<std::uint16_t> millimetres;

  [[nodiscard]] std::uint16_t at(int u, int v) const {
    return millimetres[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(u)];
  }
};

/// Renders what the camera sees: floor, walls of the map, people (body_shape.h), then noise and missing
/// returns (depth_noise.h).
///
/// The optical axis is horizontal and walls are vertical, so one planar ray a column gives a wall's depth for
/// all its rows, the floor's depth is one number a row, and a body is an ellipse in each row. Everything is
/// held as inverse depth [1/m], which the nearest surface has the largest of.
class DepthCamera {
 public:
  /// Throws std::invalid_argument that names every problem of the parameters.
  DepthCamera(const DepthCameraParams& params, std::uint64_t seed);

  /// The image from a pose of base_footprint in map. Same seed, frame number and scene: same image, whatever
  /// was rendered before. The image stays valid until the next call.
  const DepthImage& render(const StaticMap& map, const sarn::Pose2D& map_from_base,
                           const std::vector<PersonState>& people, std::uint64_t frame);

  [[nodiscard]] const DepthCameraParams& params() const { return params_; }

 private:
  void castWalls(const StaticMap& map, const sarn::Pose2D& map_from_camera);
  void addBodies(const sarn::Pose2D& map_from_camera, const std::vector<PersonState>& people);
  void renderBackground(int row);
  void renderBodies(int row);
  void drawSlice(const SliceView& view);

  DepthCameraParams params_;
  DepthNoise noise_;
  DepthImage image_;
  std::vector<BodyPart> parts_;      // of everybody in view, in the camera's frame (x ahead, y left)
  std::vector<float> column_slope_;  // [1] y over x of a column's ray
  // One value a column: inverse depth [1/m] (0: nothing), probability that nothing returns.
  std::vector<float> wall_, wall_loss_, row_, row_loss_;
};

}  // namespace kobuki_sim
