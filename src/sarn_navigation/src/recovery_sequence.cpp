// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/recovery_sequence.h"

#include <cmath>
#include <utility>

#include "sarn_common/angles.h"

namespace sarn_navigation {

void RecoverySequence::start(double now, double heading, bool turn) {
  phase_ = Phase::kWait;
  clear_ = true;
  turn_ = turn;
  phase_start_ = now;
  last_heading_ = heading;
  turned_ = 0.0;
}

void RecoverySequence::reset() { phase_ = Phase::kIdle; }

bool RecoverySequence::takeClearRequest() { return std::exchange(clear_, false); }

sarn::Twist2D RecoverySequence::step(double now, double heading) {
  if (phase_ == Phase::kWait && now - phase_start_ >= params_.recovery_wait) {
    phase_ = turn_ ? Phase::kTurn : Phase::kIdle;
    phase_start_ = now;
    last_heading_ = heading;
  }
  if (phase_ != Phase::kTurn) return {};
  turned_ += std::abs(sarn::angleDifference(last_heading_, heading));
  last_heading_ = heading;
  const double time_limit = 4.0 * sarn::kPi / params_.recovery_turn_speed;  // twice what a free turn takes
  if (turned_ >= 2.0 * sarn::kPi || now - phase_start_ > time_limit) {
    phase_ = Phase::kIdle;
    return {};
  }
  return {0.0, params_.recovery_turn_speed};
}

}  // namespace sarn_navigation
