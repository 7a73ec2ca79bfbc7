// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace sarn_perception {

/// A leg as one scan shows it.
struct Leg {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] its middle
  double sigma = 0.0;                                  // [m] on each axis
  double confidence = 1.0;                             // [0, 1] that it is a leg
};

/// A torso as one depth image shows it.
struct Body {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] its middle
  double sigma = 0.0;                                  // [m] on each axis
  double confidence = 1.0;                             // [0, 1] that it is a person
};

}  // namespace sarn_perception
