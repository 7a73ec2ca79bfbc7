// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace sarn_localization {

/// Tells a lost robot by likelihoods that fell (augmented MCL: Thrun, Burgard and Fox 2005, table 8.3): a
/// slow and a fast average of the mean likelihood of the particles; the share of random particles to add is
/// max(0, 1 - w_fast / w_slow). It differs in that both averages begin at what a robot sees that knows where
/// it is, so that a wrong initial pose is noticed too.
class RecoveryMonitor {
 public:
  static constexpr double kUsual = 0.9;  // [0, 1] likelihood in a map that fits

  /// Either 0: never any random particles.
  RecoveryMonitor(double alpha_slow, double alpha_fast) : alpha_slow_(alpha_slow), alpha_fast_(alpha_fast) {}

  /// Takes the mean likelihood [0, 1] of the particles; the share of them to replace, in [0, 1].
  double add(double likelihood) {
    if (alpha_slow_ <= 0.0 || alpha_fast_ <= 0.0) return 0.0;
    slow_ += alpha_slow_ * (likelihood - slow_);
    fast_ += alpha_fast_ * (likelihood - fast_);
    return slow_ > 0.0 ? std::clamp(1.0 - fast_ / slow_, 0.0, 1.0) : 0.0;
  }
  /// The belief was replaced: what was seen lately says nothing about it.
  void forgetFast() { fast_ = std::max(fast_, slow_); }

  [[nodiscard]] double slow() const { return slow_; }
  [[nodiscard]] double fast() const { return fast_; }

 private:
  double alpha_slow_;
  double alpha_fast_;
  double slow_ = kUsual;
  double fast_ = kUsual;
};

}  // namespace sarn_localization
