// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include "timed_path_follower/follower_params.h"

namespace timed_path_follower {

/// Reads FollowerParams from nh's namespace and logs each value; throws sarn::ParameterError with every
/// problem at once.
[[nodiscard]] FollowerParams readFollowerParameters(const ros::NodeHandle& nh);

}  // namespace timed_path_follower
