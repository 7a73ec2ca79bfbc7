// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "sarn_common/people.h"
#include "social_costmap/social_params.h"

namespace social_costmap_ros {

/// Around everybody where the prediction has them at `time` [s]: a red cylinder of the forbidden radius (the
/// robot's centre stays out) and the social Gaussian as a blue skirt, whose height is the cost. Starts with a
/// marker that deletes all earlier ones; ids are unique within a kind. Nobody when the prediction is
/// malformed.
[[nodiscard]] visualization_msgs::MarkerArray peopleMarkers(const sarn::PeoplePrediction& prediction,
                                                            const social_costmap::SocialParams& params,
                                                            double time, const std::string& frame);

}  // namespace social_costmap_ros
