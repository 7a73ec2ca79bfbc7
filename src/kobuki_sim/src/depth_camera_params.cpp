// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/depth_camera_params.h"

namespace kobuki_sim {

std::vector<std::string> DepthCameraParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(range_min < range_max)) conflicts.emplace_back("range_min: must be less than range_max");
  if (!(grazing_cos_none <= grazing_cos_full)) {
    conflicts.emplace_back("grazing_cos_none: must not exceed grazing_cos_full");
  }
  if (!(mount_z < wall_height)) conflicts.emplace_back("mount_z: must be less than wall_height");
  return conflicts;
}

}  // namespace kobuki_sim
