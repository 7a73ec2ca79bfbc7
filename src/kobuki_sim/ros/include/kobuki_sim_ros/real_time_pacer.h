// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

namespace kobuki_sim {

/// Ties simulation time to wall time at a constant factor. A simulation that cannot keep up falls behind for
/// good: what it lost is not made up for by running faster later, beyond a quarter of a second.
class RealTimePacer {
 public:
  explicit RealTimePacer(double rate) : rate_(rate) {}  // [1] simulated per wall second, > 0

  /// How long to wait [s] at wall time `wall` [s] until the simulation may show its state at `time` [ns].
  [[nodiscard]] double delay(std::int64_t time, double wall) {
    if (!started_) restart(time, wall);
    const double due = wall_start_ + 1e-9 * static_cast<double>(time - time_start_) / rate_;
    if (wall - due > kMaxLag) restart(time, wall);
    return std::max(0.0, due - wall);
  }
  /// The next call of delay() starts anew (after a pause).
  void stop() { started_ = false; }

 private:
  static constexpr double kMaxLag = 0.25;  // [s]

  void restart(std::int64_t time, double wall) {
    started_ = true;
    time_start_ = time;
    wall_start_ = wall;
  }

  double rate_;
  bool started_ = false;
  std::int64_t time_start_ = 0;  // [ns]
  double wall_start_ = 0.0;      // [s]
};

}  // namespace kobuki_sim
