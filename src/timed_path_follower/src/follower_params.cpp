// SPDX-License-Identifier: BSD-3-Clause
#include "timed_path_follower/follower_params.h"

namespace timed_path_follower {

std::vector<std::string> FollowerParams::conflicts() const {
  std::vector<std::string> all;
  if (!(slow_down_error < max_position_error)) {
    all.emplace_back("slow_down_error: must be smaller than max_position_error");
  }
  if (!(obstacle_step <= obstacle_horizon || obstacle_horizon == 0.0)) {
    all.emplace_back("obstacle_step: must not be larger than obstacle_horizon");
  }
  return all;
}

}  // namespace timed_path_follower
