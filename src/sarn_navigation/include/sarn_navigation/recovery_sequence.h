// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sarn_common/pose2d.h"
#include "sarn_navigation/navigator_params.h"

namespace sarn_navigation {

/// What the robot does when it makes no progress and nobody is near: forget the obstacles seen, wait a
/// moment, turn once to look around (an Xtion sees 58 degrees only). The caller plans again after each
/// sequence.
class RecoverySequence {
 public:
  explicit RecoverySequence(const NavigatorParams& params) : params_(params) {}

  /// `turn`: there is room to turn.
  void start(double now, double heading, bool turn = true);
  void reset();
  [[nodiscard]] bool active() const { return phase_ != Phase::kIdle; }
  /// True once, at the beginning of each sequence: obstacles are to be cleared now.
  [[nodiscard]] bool takeClearRequest();
  /// Command for this control cycle; ends the sequence after one whole turn or its time limit.
  [[nodiscard]] sarn::Twist2D step(double now, double heading);

 private:
  enum class Phase { kIdle, kWait, kTurn };

  NavigatorParams params_;
  Phase phase_ = Phase::kIdle;
  bool clear_ = false;
  bool turn_ = true;
  double phase_start_ = 0.0;   // [s]
  double last_heading_ = 0.0;  // [rad]
  double turned_ = 0.0;        // [rad]
};

}  // namespace sarn_navigation
