// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kobuki_sim/people/orca.h"

namespace kobuki_sim {

/// Parameters of the social force model; the defaults are those that Moussaid et al. (2009, 2010) measured.
struct SocialForceParams {
  double relaxation_time = 0.54;      // [s] > 0, tau: towards the desired velocity
  double interaction_strength = 4.5;  // [m/s^2] A
  double interaction_range = 0.35;    // [s] gamma: range B of the interaction per relative speed
  double angular_range_turn = 2.0;    // n: angular width of the turning
  double angular_range_slow = 3.0;    // n': angular width of the slowing down
  double velocity_weight = 2.0;       // lambda: relative velocity against direction
  double wall_strength = 3.0;         // [m/s^2] a
  double wall_range = 0.1;            // [m] > 0, b
  double contact_stiffness = 80.0;    // [1/s^2] acceleration per overlap of two bodies
  double group_gaze = 4.0;            // [1/s] beta_1: slowing down to see each other
  double group_attraction = 3.0;      // [m/s^2] beta_2: towards the middle of the group
  double group_repulsion = 1.0;       // [m/s^2] beta_3: members who are too near
  double group_distance = 0.8;        // [m] d_0: members nearer than this repel
  double neighbor_dist = 5.0;         // [m] people farther away exert no force
};

/// (v_0 e - v) / tau: equation 2 of Helbing and Molnar, "Social force model for pedestrian dynamics" (1995).
[[nodiscard]] Eigen::Vector2d desiredForce(const Eigen::Vector2d& desired_velocity,
                                           const Eigen::Vector2d& velocity, const SocialForceParams& params);

/// Acceleration [m/s^2] of `self` away from `other`, exponential in distance and anisotropic: along the
/// direction of interaction D = lambda (v_i - v_j) + e_ij it slows down, across it turns to the side where
/// the other is not (Moussaid et al., "Experimental study of the behavioural mechanisms underlying
/// self-organization in human crowds", 2009, section 3). Exactly ahead counts as slightly to the left, so
/// people turn to their right.
[[nodiscard]] Eigen::Vector2d interactionForce(const MovingDisc& self, const MovingDisc& other,
                                               const SocialForceParams& params);

/// Elastic acceleration [m/s^2] of two bodies that overlap (the body force of Helbing, Farkas and Vicsek,
/// 2000).
[[nodiscard]] Eigen::Vector2d contactForce(const MovingDisc& self, const MovingDisc& other,
                                           const SocialForceParams& params);

/// a exp(-d / b) away from the nearest wall point, d [m] from the body's rim (Moussaid et al. 2009).
[[nodiscard]] Eigen::Vector2d wallForce(const MovingDisc& self, const Eigen::Vector2d& wall_point,
                                        const SocialForceParams& params);

/// Cohesion of a group: slow down when the middle of the others is out of sight, walk towards the group's
/// middle when it is far, keep `group_distance` from each member (Moussaid et al., "The walking behaviour of
/// pedestrian social groups and its impact on crowd dynamics", 2010). `others` are the fellow members.
[[nodiscard]] Eigen::Vector2d groupForce(const MovingDisc& self, const Eigen::Vector2d& desired_direction,
                                         const std::vector<Eigen::Vector2d>& others,
                                         const SocialForceParams& params);

}  // namespace kobuki_sim
