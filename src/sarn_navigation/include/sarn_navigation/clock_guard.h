// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sarn_navigation {

/// Notices a clock that runs backwards (a restarted simulation, a looped bag), after which every remembered
/// time lies.
class ClockGuard {
 public:
  /// True when `now` [s] lies before the latest time seen; from then on `now` is the latest.
  [[nodiscard]] bool jumpedBack(double now) {
    const bool back = now < latest_;
    latest_ = now;
    return back;
  }

 private:
  double latest_ = 0.0;  // [s]
};

}  // namespace sarn_navigation
