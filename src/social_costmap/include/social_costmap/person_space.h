// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "social_costmap/social_params.h"

namespace social_costmap {

/// A person at one time.
struct PersonState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] map
  double heading = 0.0;                                // [rad] map, of the velocity
  double speed = 0.0;                                  // [m/s] >= 0
  double sigma = 0.0;                                  // [m] uncertainty of the position
};

/// A Gaussian that moves `length` along its heading: the cost of a point is the largest it takes on the way,
/// without sampling. Ahead of the end sigma_front counts, behind the start sigma_rear, in between only the
/// side.
struct SweptGaussian {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  // [m] centre at the start
  double heading = 0.0;                             // [rad]
  double length = 0.0;                              // [m] >= 0
  double sigma_front = 1.0;                         // [m]
  double sigma_rear = 1.0;                          // [m]
  double sigma_side = 1.0;                          // [m]
  double amplitude = 0.0;                           // cost at the centre
};

/// Cost at a point [m]: the formula itself, which the painter approximates.
[[nodiscard]] double costAt(const SweptGaussian& gaussian, const Eigen::Vector2d& point);

/// Where the robot's centre must not be while a person walks from a to b: nearer than radius to that segment.
struct SweptDisc {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d b = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.0;                          // [m]
};

/// The space of a person who moves from one state to another (Kollmitz et al. 2015, section III; paper
/// section IV-B b): a Gaussian with amplitude A, sigma_x along and sigma_y across the heading, its centre
/// moved ahead and to the person's right. Somebody who keeps to his own right of an oncoming person, and
/// somebody who overtakes on the left, both pass on that person's LEFT: so the right-hand side costs more.
/// Layer: index of the time layer, for the time factors. The states' headings should differ little; the
/// middle of both counts.
[[nodiscard]] SweptGaussian gaussianOf(const SocialParams& params, const PersonState& from,
                                       const PersonState& to, int layer);

/// Radius [m] of the disc round a person that is not traversable; 0 when there is none.
[[nodiscard]] double forbiddenRadius(const SocialParams& params, double sigma, int layer);

}  // namespace social_costmap
