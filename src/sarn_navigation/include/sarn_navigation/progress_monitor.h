// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace sarn_navigation {

/// When the robot last came closer to its goal.
class ProgressMonitor {
 public:
  explicit ProgressMonitor(double distance) : distance_(distance) {}

  void reset(double now) {
    best_ = std::numeric_limits<double>::infinity();
    stamp_ = now;
  }
  /// Returns true when `remaining` [m] is at least `distance` less than the least before.
  bool observe(double now, double remaining) {
    if (remaining > best_ - distance_) return false;
    best_ = remaining;
    stamp_ = now;
    return true;
  }
  /// Gives the robot more time without forgetting the best distance.
  void touch(double now) { stamp_ = now; }
  [[nodiscard]] double stalledFor(double now) const { return now - stamp_; }  // [s]

 private:
  double distance_;  // [m]
  double best_ = std::numeric_limits<double>::infinity();
  double stamp_ = 0.0;
};

}  // namespace sarn_navigation
