// SPDX-License-Identifier: BSD-3-Clause
#include "timed_path_follower/tracking_law.h"

#include <cmath>

#include "sarn_common/angles.h"

namespace timed_path_follower {

sarn::Pose2D trackingError(const sarn::Pose2D& robot, const sarn::Pose2D& reference) {
  return sarn::inverse(robot) * reference;
}

sarn::Twist2D trackingLaw(const sarn::Pose2D& error, const sarn::Twist2D& reference,
                          const TrackingGains& gains) {
  const double s = std::sin(error.theta);
  return {reference.v * std::cos(error.theta) + gains.along * error.x,
          reference.omega + reference.v * gains.across * error.y + std::abs(reference.v) * gains.heading * s +
              gains.turning * s};
}

double lyapunov(const sarn::Pose2D& error, const TrackingGains& gains) {
  return 0.5 * (error.x * error.x + error.y * error.y) + (1.0 - std::cos(error.theta)) / gains.across;
}

}  // namespace timed_path_follower
