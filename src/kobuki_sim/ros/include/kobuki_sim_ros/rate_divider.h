// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace kobuki_sim {

/// Tells in which steps something of a lower frequency is due: the first step at or after each multiple of
/// its period, so that 30 Hz holds on average on steps of 0.01 s.
class RateDivider {
 public:
  explicit RateDivider(double frequency) : frequency_(frequency) {}  // [Hz] > 0

  /// Whether it is due at `time` [ns], given that times grow. The first call is due.
  [[nodiscard]] bool due(std::int64_t time) {
    // A nanosecond of tolerance: 1/30 s is no whole number of nanoseconds.
    const auto count = static_cast<std::int64_t>(1e-9 * static_cast<double>(time + 1) * frequency_);
    if (count == last_count_) return false;
    last_count_ = count;
    return true;
  }

 private:
  double frequency_;
  std::int64_t last_count_ = -1;
};

}  // namespace kobuki_sim
