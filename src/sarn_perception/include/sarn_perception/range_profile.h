// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn_perception {

/// How far a sensor saw at uniform bearings, at one moment. NaN: nothing is known there; infinite: free up to
/// max_range.
struct RangeProfile {
  double angle_min = 0.0;        // [rad] of the first bearing
  double angle_increment = 0.0;  // [rad] > 0
  double max_range = 0.0;        // [m] nothing is known beyond
  std::vector<float> ranges;     // [m]
};

/// What a look at a place found; shares [0, 1] of the lines of sight across its width. What is missing to 1
/// is hidden, beside the view or unknown.
struct Sight {
  double through = 0.0;  // the sensor saw past the place: nobody stands there
  double onto = 0.0;     // something was seen right at the place
};

/// Looks at a disc, given in the sensor's frame [m].
[[nodiscard]] Sight lookAt(const RangeProfile& profile, const Eigen::Vector2d& center, double radius);

}  // namespace sarn_perception
