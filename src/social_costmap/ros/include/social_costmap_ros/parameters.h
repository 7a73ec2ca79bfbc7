// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <social_costmap/SocialConfig.h>

#include "social_costmap/timed_costmap.h"

namespace social_costmap_ros {

/// Reads static/, obstacle/, inflation/ and social/ below nh's namespace (usually ~costmap); other keys there
/// are errors. Throws sarn::ParameterError.
[[nodiscard]] social_costmap::CostmapParams readCostmapParams(const ros::NodeHandle& nh);

/// What dynamic_reconfigure may change live; the other fields come from `base`.
[[nodiscard]] social_costmap::SocialParams fromConfig(const social_costmap::SocialConfig& config,
                                                      social_costmap::SocialParams base);
[[nodiscard]] social_costmap::SocialConfig toConfig(const social_costmap::SocialParams& params);

}  // namespace social_costmap_ros
