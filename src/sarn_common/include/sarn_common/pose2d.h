// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "sarn_common/angles.h"

namespace sarn {

/// A planar pose, and the rigid transform that maps points of the posed frame into the frame the pose is
/// given in.
struct Pose2D {
  double x = 0.0;      // [m]
  double y = 0.0;      // [m]
  double theta = 0.0;  // [rad], counter-clockwise from x

  [[nodiscard]] Eigen::Vector2d position() const { return {x, y}; }
};

/// Velocity of a differential drive in its own base_link.
struct Twist2D {
  double v = 0.0;      // [m/s] forward
  double omega = 0.0;  // [rad/s] counter-clockwise
};

/// p_a = a_from_b * p_b.
[[nodiscard]] inline Eigen::Vector2d operator*(const Pose2D& a_from_b, const Eigen::Vector2d& p_b) {
  const double c = std::cos(a_from_b.theta);
  const double s = std::sin(a_from_b.theta);
  return {a_from_b.x + c * p_b.x() - s * p_b.y(), a_from_b.y + s * p_b.x() + c * p_b.y()};
}

/// a_from_c = a_from_b * b_from_c; the heading is wrapped to (-pi, pi].
[[nodiscard]] inline Pose2D operator*(const Pose2D& a_from_b, const Pose2D& b_from_c) {
  const Eigen::Vector2d p = a_from_b * b_from_c.position();
  return {p.x(), p.y(), wrapAngle(a_from_b.theta + b_from_c.theta)};
}

[[nodiscard]] inline Pose2D inverse(const Pose2D& a_from_b) {
  const double c = std::cos(a_from_b.theta);
  const double s = std::sin(a_from_b.theta);
  return {-c * a_from_b.x - s * a_from_b.y, s * a_from_b.x - c * a_from_b.y, wrapAngle(-a_from_b.theta)};
}

/// Exact motion along a circular arc with constant (v, omega) for `dt` [s] >= 0.
[[nodiscard]] inline Pose2D advance(const Pose2D& pose, const Twist2D& twist, double dt) {
  const double turn = twist.omega * dt;
  const double length = twist.v * dt;
  const double half = 0.5 * turn;
  const double chord =
      std::abs(half) < 1e-6 ? length * (1.0 - half * half / 6.0) : length * std::sin(half) / half;
  return {pose.x + chord * std::cos(pose.theta + half), pose.y + chord * std::sin(pose.theta + half),
          wrapAngle(pose.theta + turn)};
}

}  // namespace sarn
