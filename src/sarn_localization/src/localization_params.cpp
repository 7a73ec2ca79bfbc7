// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/localization_params.h"

#include <cmath>

namespace sarn_localization {

std::vector<std::string> LocalizationParams::conflicts() const {
  std::vector<std::string> problems;
  checkFrames("global_frame_id, odom_frame_id, base_frame_id", global_frame_id, odom_frame_id, base_frame_id,
              problems);
  if (min_particles > max_particles) problems.emplace_back("min_particles: must not exceed max_particles");
  if (laser_min_range >= laser_max_range) {
    problems.emplace_back("laser_min_range: must be less than laser_max_range");
  }
  if (std::abs(laser_z_hit + laser_z_rand - 1.0) > 1e-6) {
    problems.emplace_back("laser_z_hit, laser_z_rand: must add up to 1");
  }
  if (recovery_alpha_fast > 0.0 && recovery_alpha_slow >= recovery_alpha_fast) {
    problems.emplace_back("recovery_alpha_slow: must be less than recovery_alpha_fast");
  }
  return problems;
}

BeamLimits beamLimits(const LocalizationParams& params) {
  return {static_cast<std::size_t>(params.laser_max_beams), params.laser_min_range, params.laser_max_range,
          params.laser_range_bias, params.laser_beam_offset};
}

}  // namespace sarn_localization
