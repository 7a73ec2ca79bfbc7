// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kobuki_sim/people/person_model.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// A horizontal ellipse: a body cut at one height.
struct BodySlice {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
  double along = 0.0;                                // [m] semi-axis along the part's yaw, > 0
  double across = 0.0;                               // [m] semi-axis across it, > 0
};

/// A part of a body: ellipses stacked between two heights, whose centre and semi-axes change linearly with
/// the height; a rounded part closes at both ends as an ellipsoid does.
struct BodyPart {
  double bottom = 0.0;  // [m] above the floor
  double top = 0.0;     // [m] > bottom
  BodySlice lower;      // at bottom
  BodySlice upper;      // at top
  double yaw = 0.0;     // [rad]
  bool rounded = false;

  /// The cut at a height [m] in [bottom, top].
  [[nodiscard]] BodySlice at(double height) const;
};

inline constexpr double kBodyHeight = 1.75;  // [m] of everybody

/// Two legs with feet that swing about the hips with the walking phase, a torso and a head, in map. The feet
/// move half a step (people/gait.h) ahead of and behind the person's centre, the left one as
/// sin(walking_phase). Segment
/// lengths as fractions of the body height after Drillis and Contini (1966), as given by Winter (2009),
/// fig. 4.1. People slimmer than 0.25 m in radius get proportionally narrower bodies.
[[nodiscard]] std::vector<BodyPart> walkingBody(const PersonState& person);

/// The part seen from another frame.
[[nodiscard]] BodyPart transformed(const sarn::Pose2D& to_from_part, const BodyPart& part);

}  // namespace kobuki_sim
