// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/timed_plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "sarn_common/angles.h"

namespace sarn_move_base {
namespace {

constexpr double kSlack = 0.05;  // [m/s], [rad/s] beyond the limits before recovered speeds are not believed

void checkFinite(const std::vector<StampedPose>& poses) {
  if (poses.empty()) throw std::invalid_argument("the plan is empty");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const StampedPose& p = poses[i];
    if (std::isfinite(p.pose.x) && std::isfinite(p.pose.y) && std::isfinite(p.pose.theta) &&
        std::isfinite(p.t)) {
      continue;
    }
    throw std::invalid_argument("pose " + std::to_string(i) + " of the plan is not finite");
  }
}

/// How many poses from the first carry growing times.
std::size_t timedPoses(const std::vector<StampedPose>& poses) {
  if (poses.front().t <= 0.0) return 0;
  std::size_t count = 1;
  while (count < poses.size() && poses[count].t > poses[count - 1].t) ++count;
  return count;
}

/// Mean speeds between two poses that an arc joins.
sarn::Twist2D meanSpeeds(const StampedPose& a, const StampedPose& b) {
  const double dt = b.t - a.t;
  const double turn = sarn::angleDifference(a.pose.theta, b.pose.theta);
  const Eigen::Vector2d d = b.pose.position() - a.pose.position();
  const double middle = a.pose.theta + 0.5 * turn;
  const double chord = d.x() * std::cos(middle) + d.y() * std::sin(middle);  // with its sign
  const double half = 0.5 * turn;
  const double arc = std::abs(half) < 1e-6 ? chord : chord * half / std::sin(half);
  return {arc / dt, turn / dt};
}

sarn::TimedTrajectory withSpeeds(const std::vector<StampedPose>& poses, std::size_t count,
                                 const DriveLimits& limits) {
  sarn::TimedTrajectory trajectory;
  for (std::size_t i = 0; i < count; ++i) {
    const sarn::Pose2D& p = poses[i].pose;
    trajectory.points.push_back({p.x, p.y, p.theta, 0.0, 0.0, poses[i].t});
  }
  std::vector<sarn::Twist2D> means;
  for (std::size_t i = 0; i + 1 < count; ++i) means.push_back(meanSpeeds(poses[i], poses[i + 1]));
  auto& points = trajectory.points;
  bool plausible = true;
  for (std::size_t i = means.size(); i-- > 0;) {
    points[i].v = 2.0 * means[i].v - points[i + 1].v;
    points[i].omega = 2.0 * means[i].omega - points[i + 1].omega;
    plausible = plausible && std::abs(points[i].v) <= limits.max_vel_x + kSlack &&
                std::abs(points[i].omega) <= limits.max_vel_theta + kSlack;
  }
  if (plausible) return trajectory;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const sarn::Twist2D& before = means[i > 0 ? i - 1 : 0];
    points[i].v = std::clamp(0.5 * (before.v + means[i].v), -limits.max_vel_x, limits.max_vel_x);
    points[i].omega =
        std::clamp(0.5 * (before.omega + means[i].omega), -limits.max_vel_theta, limits.max_vel_theta);
  }
  return trajectory;
}

}  // namespace

std::vector<StampedPose> encode(const TimedPlan& plan) {
  std::vector<StampedPose> poses;
  for (const auto& point : plan.trajectory.points) poses.push_back({point.pose(), point.t});
  poses.push_back({plan.goal, 0.0});
  return poses;
}

TimedPlan decode(const std::vector<StampedPose>& poses, const DriveLimits& limits,
                 const sarn::Twist2D& measured, double now) {
  checkFinite(poses);
  const std::size_t timed = timedPoses(poses);
  const bool all = timed == poses.size() && timed > 1;
  const bool but_goal = timed > 0 && timed + 1 == poses.size() && poses.back().t <= 0.0;
  if (all || but_goal) return {withSpeeds(poses, timed, limits), poses.back().pose};
  std::vector<sarn::Pose2D> path;
  for (const StampedPose& p : poses) path.push_back(p.pose);
  return {timePath(path, limits, std::max(0.0, measured.v), now), poses.back().pose};
}

}  // namespace sarn_move_base
