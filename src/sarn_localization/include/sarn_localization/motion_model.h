// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "sarn_common/pose2d.h"
#include "sarn_localization/pose_belief.h"

namespace sarn_localization {

/// Variances of a measured motion: per squared rotation and translation.
struct MotionNoise {
  double alpha1 = 0.0;  // [1] of rotation, from rotation
  double alpha2 = 0.0;  // [rad^2/m^2] of rotation, from translation
  double alpha3 = 0.0;  // [1] of translation, from translation
  double alpha4 = 0.0;  // [m^2/rad^2] of translation, from rotation
};

/// The true motion behind a motion of the odometry, both in the frame of the pose before it: rotate, go
/// straight, rotate, each with its own variance (Thrun, Burgard and Fox 2005, table 5.6), linearised, as the
/// motions between two scans are short. Driving backwards is as certain as driving forwards, and a turn on
/// the spot has no direction of travel.
[[nodiscard]] PoseEstimate motionBelief(const sarn::Pose2D& measured, const MotionNoise& noise);

}  // namespace sarn_localization
