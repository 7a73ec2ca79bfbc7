// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sarn_common/pose2d.h"

namespace timed_path_follower {

struct TrackingGains {
  double along = 1.0;    // [1/s] k_x of the longitudinal error, > 0
  double across = 1.0;   // [1/m^2] k_y of the lateral error, > 0
  double heading = 1.0;  // [1/m] k_theta of the heading error, > 0
  double turning = 1.0;  // [1/s] heading feedback at standstill, >= 0
};

/// Pose error of a unicycle in its own frame: where the reference lies seen from the robot (Kanayama et al.
/// 1990, eq. 5): x ahead, y to the left, theta the missing turn in (-pi, pi].
[[nodiscard]] sarn::Pose2D trackingError(const sarn::Pose2D& robot, const sarn::Pose2D& reference);

/// Velocities that track a moving reference of speeds (v_r, omega_r):
///
///   v     = v_r cos(e_theta) + k_x e_x
///   omega = omega_r + |v_r| (k_y e_y s + k_theta sin(e_theta)) + k_t sin(e_theta),   s = sign(v_r)
///
/// the control of Kanayama, Kimura, Miyazaki and Noguchi, "A stable tracking control method for an autonomous
/// mobile robot", ICRA 1990 (eq. 8), with two additions: the sign, so that it holds when the reference drives
/// backwards too (Samson 1993), and k_t, so that heading errors also vanish while the reference stands or
/// turns in place.
///
/// Lyapunov function V = (e_x^2 + e_y^2) / 2 + (1 - cos(e_theta)) / k_y (Kanayama's proposition 1). With the
/// error dynamics  e_x' = omega e_y - v + v_r cos(e_theta),  e_y' = -omega e_x + v_r sin(e_theta),  e_theta'
/// = omega_r - omega:
///   V' = -k_x e_x^2 - (|v_r| k_theta + k_t) sin(e_theta)^2 / k_y <= 0
/// for any k_x, k_y, k_theta > 0 and k_t >= 0: the error never grows, and it vanishes while the reference
/// moves.
[[nodiscard]] sarn::Twist2D trackingLaw(const sarn::Pose2D& error, const sarn::Twist2D& reference,
                                        const TrackingGains& gains);

/// V of trackingLaw's proof.
[[nodiscard]] double lyapunov(const sarn::Pose2D& error, const TrackingGains& gains);

}  // namespace timed_path_follower
