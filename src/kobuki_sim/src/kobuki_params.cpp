// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/kobuki_params.h"

namespace kobuki_sim {

std::vector<std::string> KobukiParams::conflicts() const {
  std::vector<std::string> found;
  if (battery_empty >= battery_full) found.emplace_back("battery_empty: must be below battery_full");
  if (wheel_separation > 2.0 * hull_radius)
    found.emplace_back("wheel_separation: wheels stand outside hull_radius");
  return found;
}

KobukiParams KobukiParams::ideal() {
  KobukiParams params;
  params.command_delay = 0.0;
  params.quantise_commands = false;
  params.wheel_scale_sigma = params.wheel_slip_noise = 0.0;
  params.gyro_noise = params.gyro_bias_sigma = params.gyro_bias_walk = params.gyro_scale_sigma = 0.0;
  return params;
}

}  // namespace kobuki_sim
