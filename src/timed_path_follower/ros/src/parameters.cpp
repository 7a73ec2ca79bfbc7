// SPDX-License-Identifier: BSD-3-Clause
#include "timed_path_follower_ros/parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace timed_path_follower {

FollowerParams readFollowerParameters(const ros::NodeHandle& nh) {
  return sarn::readParameters<FollowerParams>(nh);
}

}  // namespace timed_path_follower
