// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/motion_model.h"

#include <algorithm>
#include <cmath>

namespace sarn_localization {
namespace {

constexpr double kOnTheSpot = 0.01;  // [m] shorter motions have no direction

/// Angle [rad] of a rotation or of the same rotation driven backwards, whichever is smaller.
double leastTurn(double angle) { return std::min(std::abs(angle), sarn::kPi - std::abs(angle)); }

}  // namespace

PoseEstimate motionBelief(const sarn::Pose2D& measured, const MotionNoise& noise) {
  const double trans = std::hypot(measured.x, measured.y);
  const double rot1 = trans < kOnTheSpot ? 0.0 : std::atan2(measured.y, measured.x);
  const double rot2 = sarn::angleDifference(rot1, measured.theta);
  const double turn1 = leastTurn(rot1);
  const double turn2 = trans < kOnTheSpot ? std::abs(rot2) : leastTurn(rot2);

  const double straight = trans * trans;
  const Eigen::Vector3d variances(noise.alpha1 * turn1 * turn1 + noise.alpha2 * straight,
                                  noise.alpha3 * straight + noise.alpha4 * (turn1 * turn1 + turn2 * turn2),
                                  noise.alpha1 * turn2 * turn2 + noise.alpha2 * straight);
  // x = trans cos(rot1), y = trans sin(rot1), theta = rot1 + rot2 by (rot1, trans, rot2).
  Eigen::Matrix3d jacobian;
  jacobian << -trans * std::sin(rot1), std::cos(rot1), 0.0,  //
      trans * std::cos(rot1), std::sin(rot1), 0.0,           //
      1.0, 0.0, 1.0;
  return {measured, jacobian * variances.asDiagonal() * jacobian.transpose()};
}

}  // namespace sarn_localization
