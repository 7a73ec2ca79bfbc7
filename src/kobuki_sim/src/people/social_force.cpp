// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/social_force.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kSmall = 1e-9;
constexpr double kStraight = 1e-6;  // [rad] rounding does not decide on which side somebody is
constexpr double kHalfFieldOfView = 0.5 * sarn::kPi;  // [rad] a fellow farther from the gaze is out of sight

/// Direction from a to b, or any where they coincide.
Vector2d unitFrom(const Vector2d& a, const Vector2d& b) {
  const Vector2d d = b - a;
  const double norm = d.norm();
  return norm > kSmall ? Vector2d(d / norm) : Vector2d(Vector2d::UnitX());
}

double signedAngle(const Vector2d& from, const Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

}  // namespace

Vector2d desiredForce(const Vector2d& desired_velocity, const Vector2d& velocity,
                      const SocialForceParams& params) {
  return (desired_velocity - velocity) / params.relaxation_time;
}

Vector2d interactionForce(const MovingDisc& self, const MovingDisc& other, const SocialForceParams& params) {
  const double distance = (other.position - self.position).norm();
  const Vector2d towards = unitFrom(self.position, other.position);
  const Vector2d interaction = params.velocity_weight * (self.velocity - other.velocity) + towards;
  const double norm = interaction.norm();
  if (norm < kSmall) return Vector2d::Zero();
  const Vector2d tangent = interaction / norm;  // t of the paper
  const Vector2d normal(-tangent.y(), tangent.x());
  const double range = params.interaction_range * norm;  // B = gamma |D|
  const double angle = signedAngle(tangent, towards);    // theta, positive: the other is on the left
  const double side = angle > -kStraight && angle < sarn::kPi - kStraight ? 1.0 : -1.0;
  const auto bell = [&](double n) { return std::exp(-distance / range - std::pow(n * range * angle, 2)); };
  const double slow = -params.interaction_strength * bell(params.angular_range_slow);
  const double turn = -params.interaction_strength * side * bell(params.angular_range_turn);
  return slow * tangent + turn * normal;
}

Vector2d contactForce(const MovingDisc& self, const MovingDisc& other, const SocialForceParams& params) {
  const double overlap = self.radius + other.radius - (other.position - self.position).norm();
  if (overlap <= 0.0) return Vector2d::Zero();
  return -params.contact_stiffness * overlap * unitFrom(self.position, other.position);
}

Vector2d wallForce(const MovingDisc& self, const Vector2d& wall_point, const SocialForceParams& params) {
  const double distance = (self.position - wall_point).norm() - self.radius;
  return params.wall_strength * std::exp(-std::max(distance, 0.0) / params.wall_range) *
         unitFrom(wall_point, self.position);
}

Vector2d groupForce(const MovingDisc& self, const Vector2d& desired_direction,
                    const std::vector<Vector2d>& others, const SocialForceParams& params) {
  if (others.empty()) return Vector2d::Zero();
  Vector2d sum = Vector2d::Zero();
  for (const Vector2d& other : others) sum += other;
  const double count = static_cast<double>(others.size());
  const Vector2d middle_of_others = sum / count;
  const Vector2d middle = (sum + self.position) / (count + 1.0);

  const double gaze_angle =
      std::abs(signedAngle(desired_direction, unitFrom(self.position, middle_of_others)));
  const double turn_of_head = std::max(0.0, gaze_angle - kHalfFieldOfView);  // alpha
  Vector2d force = -params.group_gaze * turn_of_head * self.velocity;
  if ((middle - self.position).norm() > 0.5 * count) {
    force += params.group_attraction * unitFrom(self.position, middle);
  }
  for (const Vector2d& other : others) {
    if ((other - self.position).norm() < params.group_distance) {
      force += params.group_repulsion * unitFrom(other, self.position);
    }
  }
  return force;
}

}  // namespace kobuki_sim
