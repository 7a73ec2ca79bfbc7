// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sarn_common/pose2d.h"

namespace social_costmap {

/// One laser scan with the pose of its sensor.
struct Scan {
  sarn::Pose2D sensor_in_map;
  double angle_min = 0.0;        // [rad] of the first beam, in the sensor's frame
  double angle_increment = 0.0;  // [rad] from beam to beam
  double range_min = 0.0;        // [m] smaller returns are no returns
  double range_max = 0.0;        // [m] larger returns are no returns
  double stamp = 0.0;            // [s]
  std::vector<float> ranges;     // [m] +inf: nothing within range_max; NaN: no measurement
};

/// One line that says why the scan cannot be used; nothing when it can (single bad ranges are no reason).
[[nodiscard]] std::optional<std::string> problem(const Scan& scan);

}  // namespace social_costmap
