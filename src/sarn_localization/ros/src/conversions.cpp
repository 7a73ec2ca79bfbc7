// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/conversions.h"

#include <cmath>
#include <cstddef>

#include "sarn_common_ros/conversions.h"

namespace sarn_localization {
namespace {

// Places of x, y and yaw in the 6 x 6 covariance of a pose message.
constexpr int kPlaces[3] = {0, 1, 5};
constexpr int kEdge = 6;

}  // namespace

std::string scanProblem(const sensor_msgs::LaserScan& message) {
  if (message.ranges.empty()) return "no ranges";
  if (!std::isfinite(message.angle_min) || !std::isfinite(message.angle_increment) ||
      message.angle_increment == 0.0F) {
    return "angle_min and angle_increment must be finite, and the increment not 0";
  }
  if (!std::isfinite(message.range_min) || !(message.range_max > message.range_min)) {
    return "range_max must be greater than range_min";
  }
  return {};
}

PlanarScan fromMessage(const sensor_msgs::LaserScan& message) {
  return {static_cast<double>(message.angle_min),
          static_cast<double>(message.angle_increment),
          static_cast<double>(message.range_min),
          static_cast<double>(message.range_max),
          message.ranges,
          message.header.stamp.toSec()};
}

std::optional<PoseEstimate> fromMessage(const geometry_msgs::PoseWithCovariance& message) {
  const auto pose = sarn::fromMessage(message.pose);
  if (!pose) return std::nullopt;
  PoseEstimate estimate{*pose, Eigen::Matrix3d::Zero()};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      estimate.covariance(row, column) =
          message.covariance[static_cast<std::size_t>(kPlaces[row] * kEdge + kPlaces[column])];
    }
  }
  if (!estimate.covariance.allFinite() || (estimate.covariance.diagonal().array() < 0.0).any()) {
    return std::nullopt;
  }
  return estimate;
}

geometry_msgs::PoseWithCovariance toMessage(const PoseEstimate& estimate) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = sarn::toMessage(estimate.pose);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.covariance[static_cast<std::size_t>(kPlaces[row] * kEdge + kPlaces[column])] =
          estimate.covariance(row, column);
    }
  }
  return message;
}

geometry_msgs::PoseArray toMessage(const std::vector<WeightedPose>& particles) {
  geometry_msgs::PoseArray message;
  message.poses.reserve(particles.size());
  for (const WeightedPose& particle : particles) message.poses.push_back(sarn::toMessage(particle.pose));
  return message;
}

}  // namespace sarn_localization
