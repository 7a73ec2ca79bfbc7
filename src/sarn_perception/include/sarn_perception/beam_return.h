// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace sarn_perception {

/// What one column, and then one beam, of a depth image says.
struct BeamReturn {
  float range = std::numeric_limits<float>::infinity();  // [m] nearest within limits; infinite: none
  bool beyond = false;                                   // something was seen beyond range_max
  bool too_close = false;                                // something was seen nearer than range_min
  bool seen = false;                                     // a pixel falls on the beam

  [[nodiscard]] bool empty() const {
    return range == std::numeric_limits<float>::infinity() && !beyond && !too_close;
  }
};

}  // namespace sarn_perception
