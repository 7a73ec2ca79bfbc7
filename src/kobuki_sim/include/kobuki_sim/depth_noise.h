// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/depth_camera_params.h"

namespace kobuki_sim {

/// Standard deviation [m] of a Kinect's depth at z [m] along the axis, on surfaces within 60 deg of facing
/// it: 0.0012 + 0.0019 (z - 0.4)^2 (Nguyen, Izadi and Lovell 2012, eq. 3).
[[nodiscard]] double axialNoise(double z);

/// Probability that a surface seen at this cosine of incidence returns nothing: the drop probability at
/// grazing_cos_full and above, rising linearly to 1 at grazing_cos_none.
[[nodiscard]] double lossProbability(const DepthCameraParams& params, double cos_incidence);

/// What a structured-light camera makes of true inverse depths: axial noise, depth in steps of disparity
/// (f b / z in units of 1 / disparity_steps px, Khoshelham and Elberink 2012), shadows of the projector,
/// which stands to the right of the camera, lost pixels, and nothing out of range.
class DepthNoise {
 public:
  DepthNoise(const DepthCameraParams& params, std::uint64_t seed);

  /// Marks columns that the projector does not reach, by a loss of 2. Arrays of `width` values.
  void castShadows(const float* inverse_depth, float* loss);
  /// One row of millimetres from inverse depths [1/m] and probabilities of loss; a pure function of its
  /// arguments and the seed.
  void corrupt(const float* inverse_depth, const float* loss, std::uint64_t frame, int row,
               std::uint16_t* millimetres) const;

 private:
  DepthCameraParams params_;
  std::uint64_t seed_;
  std::vector<float> normal_;            // standard normal draws
  std::vector<float> uniform_;           // uniform draws in [0, 1)
  std::vector<std::int32_t> projector_;  // scratch: projector column in 1/16 px
};

}  // namespace kobuki_sim
