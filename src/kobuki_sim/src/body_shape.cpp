// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/body_shape.h"

#include <algorithm>
#include <cmath>

#include "kobuki_sim/people/gait.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

// Fractions of the body height (Winter 2009, fig. 4.1).
constexpr double kHip = 0.530;
constexpr double kShoulder = 0.818;
constexpr double kChin = 0.870;
constexpr double kAnkle = 0.039;
constexpr double kFootLength = 0.152;
constexpr double kHalfShoulder = 0.129;

// Girths [m] of an adult.
constexpr double kHalfGait = 0.09;  // from the body's middle to a leg's axis
constexpr double kAnkleRadius = 0.045;
constexpr double kThighRadius = 0.08;
constexpr double kFootHalfWidth = 0.045;
constexpr double kTorsoHalfDepth = 0.12;
constexpr double kHeadRadius = 0.09;

constexpr double kAdultRadius = 0.25;  // [m] the disc that the girths belong to

/// `side` is 1 for the left leg, -1 for the right one; `offset` [m] the foot's distance ahead of the hip.
void addLeg(double side, double offset, double girth, std::vector<BodyPart>& parts) {
  const double hip = kHip * kBodyHeight;
  const double y = side * kHalfGait * girth;
  const double ankle = kAnkleRadius * girth;
  const double thigh = kThighRadius * girth;
  parts.push_back({0.0, hip, {{offset, y}, ankle, ankle}, {{0.0, y}, thigh, thigh}});
  const double foot = 0.5 * kFootLength * kBodyHeight * girth;
  const BodySlice sole{{offset + 0.5 * foot, y}, foot, kFootHalfWidth * girth};
  parts.push_back({0.0, 2.0 * kAnkle * kBodyHeight, sole, {{offset, y}, ankle, ankle}});
}

}  // namespace

BodySlice BodyPart::at(double height) const {
  const double f = (height - bottom) / (top - bottom);
  BodySlice slice{(1.0 - f) * lower.center + f * upper.center, (1.0 - f) * lower.along + f * upper.along,
                  (1.0 - f) * lower.across + f * upper.across};
  if (rounded) {
    const double scale = std::sqrt(std::max(1e-6, 1.0 - (2.0 * f - 1.0) * (2.0 * f - 1.0)));
    slice.along *= scale;
    slice.across *= scale;
  }
  return slice;
}

std::vector<BodyPart> walkingBody(const PersonState& person) {
  const double girth = std::min(1.0, person.radius / kAdultRadius);
  const double swing = 0.5 * stepLength(person.velocity.norm()) * std::sin(person.walking_phase);
  std::vector<BodyPart> parts;
  parts.reserve(6);
  addLeg(1.0, swing, girth, parts);
  addLeg(-1.0, -swing, girth, parts);
  const double half_width = kHalfShoulder * kBodyHeight * girth;
  const BodySlice waist{{0.0, 0.0}, kTorsoHalfDepth * girth, 0.75 * half_width};
  const BodySlice chest{{0.0, 0.0}, kTorsoHalfDepth * girth, half_width};
  parts.push_back({kHip * kBodyHeight * 0.92, kShoulder * kBodyHeight, waist, chest});
  const BodySlice head{{0.0, 0.0}, kHeadRadius, kHeadRadius};
  parts.push_back({kChin * kBodyHeight - 0.03, kBodyHeight, head, head, 0.0, true});
  const sarn::Pose2D map_from_person{person.position.x(), person.position.y(), person.heading};
  for (BodyPart& part : parts) part = transformed(map_from_person, part);
  return parts;
}

BodyPart transformed(const sarn::Pose2D& to_from_part, const BodyPart& part) {
  BodyPart result = part;
  result.lower.center = to_from_part * part.lower.center;
  result.upper.center = to_from_part * part.upper.center;
  result.yaw = sarn::wrapAngle(part.yaw + to_from_part.theta);
  return result;
}

}  // namespace kobuki_sim
