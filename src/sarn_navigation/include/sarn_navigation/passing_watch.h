// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sarn_common/people.h"
#include "sarn_navigation/yield_monitor.h"

namespace sarn_navigation {

/// Tells whether the person for whom the robot moved aside has passed the place where it stood, also when the
/// robot lost sight of them in turning away: somebody who is not seen is still coming until they have had the
/// time to pass. A camera that looks ahead cannot see whom the robot drives away from.
class PassingWatch {
 public:
  /// `origin` [m]: where the robot stood in the way, `now` [s].
  PassingWatch(const BlockedPerson& person, const Eigen::Vector2d& origin, double now);

  /// People as they are now.
  void observe(const sarn::PeoplePrediction& people);
  /// The robot is in nobody's way any more.
  void robotIsAside(double now);

  /// Somebody was seen beyond the place, on the person's way and walking on.
  [[nodiscard]] bool seenBeyond() const { return seen_beyond_; }
  /// The person is not in sight and has not had the time to pass.
  [[nodiscard]] bool mayStillCome(double now) const;

 private:
  BlockedPerson person_;  // as last seen
  Eigen::Vector2d origin_;
  Eigen::Vector2d direction_;  // of the person's way
  double speed_;               // [m/s] on it
  double last_seen_;           // [s]
  double aside_ = -1.0;        // [s] since when the way is free; negative: it is not
  bool in_sight_ = true;
  bool seen_beyond_ = false;
};

}  // namespace sarn_navigation
