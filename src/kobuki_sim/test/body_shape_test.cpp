// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/body_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kobuki_sim/people/gait.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

PersonState walker(double phase) {
  PersonState person;
  person.position = {1.0, 2.0};
  person.heading = 0.5 * sarn::kPi;
  person.velocity = {0.0, 1.3};
  person.walking_phase = phase;
  return person;
}

TEST(BodyShape, reachesFromTheFloorToTheTopOfTheHead) {
  double top = 0.0;
  double bottom = 1.0;
  for (const BodyPart& part : walkingBody(walker(0.0))) {
    EXPECT_LT(part.bottom, part.top);
    top = std::max(top, part.top);
    bottom = std::min(bottom, part.bottom);
  }
  EXPECT_DOUBLE_EQ(top, kBodyHeight);
  EXPECT_DOUBLE_EQ(bottom, 0.0);
}

TEST(BodyShape, putsFeetHalfAStepAheadAndBehind) {
  const auto parts = walkingBody(walker(0.5 * sarn::kPi));
  const BodySlice left = parts[0].at(0.0);  // the left leg, heading along y: at smaller x
  const BodySlice right = parts[2].at(0.0);
  EXPECT_LT(left.center.x(), 1.0);
  EXPECT_GT(right.center.x(), 1.0);
  EXPECT_NEAR(left.center.y() - 2.0, 0.5 * stepLength(1.3), 1e-9);
  EXPECT_NEAR(right.center.y() - 2.0, -0.5 * stepLength(1.3), 1e-9);
  EXPECT_NEAR(parts[0].at(parts[0].top).center.y(), 2.0, 1e-9) << "the hip stays";
}

TEST(BodyShape, mirrorsItselfHalfACycleLater) {
  const auto now = walkingBody(walker(0.7));
  const auto later = walkingBody(walker(0.7 + sarn::kPi));
  EXPECT_NEAR(now[0].lower.center.y(), later[2].lower.center.y(), 1e-12);
  EXPECT_NEAR(now[2].lower.center.y(), later[0].lower.center.y(), 1e-12);
}

TEST(BodyShape, narrowsWithTheRadius) {
  PersonState slim = walker(0.0);
  slim.radius = 0.15;
  const auto body = walkingBody(slim);
  for (const BodyPart& part : body) {
    EXPECT_LE(part.upper.across, 0.15);
    EXPECT_LE(part.lower.across, 0.15);
  }
}

TEST(BodyPart, roundsItsEnds) {
  const BodyPart ball{0.0, 2.0, {{0.0, 0.0}, 1.0, 1.0}, {{0.0, 0.0}, 1.0, 1.0}, 0.0, true};
  EXPECT_DOUBLE_EQ(ball.at(1.0).along, 1.0);
  EXPECT_NEAR(ball.at(1.5).along, std::sqrt(0.75), 1e-12);
  EXPECT_LT(ball.at(2.0).along, 0.01);
}

}  // namespace
}  // namespace kobuki_sim
