// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "sarn_perception/people_tracker.h"

namespace sarn_perception {

/// For each person a cylinder (the fainter, the less certain that somebody is there), where it will be in a
/// second, its name, and the ellipse of two standard deviations of its position. Replaces what was drawn
/// before.
[[nodiscard]] visualization_msgs::MarkerArray trackMarkers(const std::vector<PersonTrack>& tracks,
                                                           const std_msgs::Header& header);

}  // namespace sarn_perception
