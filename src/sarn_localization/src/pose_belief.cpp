// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/pose_belief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sarn_localization {
namespace {

constexpr double kReach = 0.5;     // [m] and [rad] around a cluster's centre
constexpr int kHeadingCells = 12;  // in a turn
using CoarseCell = std::array<int, 3>;

CoarseCell coarseCell(const sarn::Pose2D& pose) {
  const double turn = (pose.theta + sarn::kPi) / (2.0 * sarn::kPi);
  return {static_cast<int>(std::floor(pose.x / kReach)), static_cast<int>(std::floor(pose.y / kReach)),
          std::min(kHeadingCells - 1, static_cast<int>(turn * kHeadingCells))};
}

/// Weighted mean of the poses that `chosen` picks; headings by their mean direction.
template <class Chosen>
sarn::Pose2D meanPose(const std::vector<WeightedPose>& particles, Chosen&& chosen) {
  double weight = 0.0;
  double x = 0.0;
  double y = 0.0;
  double cosine = 0.0;
  double sine = 0.0;
  for (const auto& [pose, w] : particles) {
    if (!chosen(pose)) continue;
    weight += w;
    x += w * pose.x;
    y += w * pose.y;
    cosine += w * std::cos(pose.theta);
    sine += w * std::sin(pose.theta);
  }
  return {x / weight, y / weight, std::atan2(sine, cosine)};
}

CoarseCell heaviestCell(const std::vector<WeightedPose>& particles) {
  std::map<CoarseCell, double> weights;
  for (const auto& [pose, weight] : particles) weights[coarseCell(pose)] += weight;
  return std::max_element(weights.begin(), weights.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

PoseEstimate heaviestCluster(const std::vector<WeightedPose>& particles) {
  const CoarseCell heaviest = heaviestCell(particles);
  const sarn::Pose2D center =
      meanPose(particles, [&](const sarn::Pose2D& pose) { return coarseCell(pose) == heaviest; });
  const auto near = [&](const sarn::Pose2D& pose) {
    return (pose.position() - center.position()).norm() <= kReach &&
           std::abs(sarn::angleDifference(center.theta, pose.theta)) <= kReach;
  };
  PoseEstimate estimate;
  estimate.pose = meanPose(particles, near);
  double total = 0.0;
  for (const auto& [pose, weight] : particles) {
    if (!near(pose)) continue;
    const Eigen::Vector3d error(pose.x - estimate.pose.x, pose.y - estimate.pose.y,
                                sarn::angleDifference(estimate.pose.theta, pose.theta));
    estimate.covariance += weight * error * error.transpose();
    total += weight;
  }
  estimate.covariance /= total;
  return estimate;
}

}  // namespace sarn_localization
