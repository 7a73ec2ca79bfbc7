// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

namespace sarn_navigation {

/// Lets one log line through per period of wall time, so that simulated time and its jumps do not matter.
class LineThrottle {
 public:
  explicit LineThrottle(double period = 5.0) : period_(period) {}  // [s]
  [[nodiscard]] bool ready() {
    const ros::WallTime now = ros::WallTime::now();
    if (!last_.isZero() && now - last_ < period_) return false;
    last_ = now;
    return true;
  }

 private:
  ros::WallDuration period_;
  ros::WallTime last_;
};

}  // namespace sarn_navigation
