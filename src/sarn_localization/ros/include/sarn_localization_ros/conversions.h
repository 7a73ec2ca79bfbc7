// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>
#include <vector>

#include "sarn_localization/pose_belief.h"
#include "sarn_localization/scan_beams.h"

// Messages <-> core values: pure functions.
namespace sarn_localization {

/// One line that says what is wrong with a scan; empty when it can be used. NaN and Inf among the ranges are
/// fine.
[[nodiscard]] std::string scanProblem(const sensor_msgs::LaserScan& message);
[[nodiscard]] PlanarScan fromMessage(const sensor_msgs::LaserScan& message);

/// Nothing when a value is not finite, the pose is not planar, or a variance is negative.
[[nodiscard]] std::optional<PoseEstimate> fromMessage(const geometry_msgs::PoseWithCovariance& message);
[[nodiscard]] geometry_msgs::PoseWithCovariance toMessage(const PoseEstimate& estimate);
[[nodiscard]] geometry_msgs::PoseArray toMessage(const std::vector<WeightedPose>& particles);

}  // namespace sarn_localization
