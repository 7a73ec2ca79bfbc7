// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn_localization {

struct WeightedPose {
  sarn::Pose2D pose;
  double weight = 1.0;  // >= 0
};

/// A pose and its covariance over (x, y, theta) [m^2, m rad, rad^2].
struct PoseEstimate {
  sarn::Pose2D pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Mean and covariance of the heaviest cluster of particles: the poses within half a metre and half a radian
/// of the centre of the heaviest cell of a coarse grid. `particles` is not empty.
[[nodiscard]] PoseEstimate heaviestCluster(const std::vector<WeightedPose>& particles);

}  // namespace sarn_localization
