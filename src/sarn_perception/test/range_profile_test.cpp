// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/range_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sarn_common/angles.h"

namespace sarn_perception {
namespace {

/// All around, everywhere `range` [m].
RangeProfile around(float range) {
  RangeProfile profile;
  profile.angle_min = -sarn::kPi;
  profile.angle_increment = 2.0 * sarn::kPi / 360.0;
  profile.max_range = 10.0;
  profile.ranges.assign(360, range);
  return profile;
}

TEST(RangeProfile, seesThroughAPlaceBeforeTheWall) {
  const Sight sight = lookAt(around(5.0F), {3.0, 0.0}, 0.2);
  EXPECT_DOUBLE_EQ(sight.through, 1.0);
  EXPECT_DOUBLE_EQ(sight.onto, 0.0);
}

TEST(RangeProfile, seesOntoWhatStandsThere) {
  const Sight sight = lookAt(around(2.9F), {0.0, 3.0}, 0.2);
  EXPECT_DOUBLE_EQ(sight.through, 0.0);
  EXPECT_DOUBLE_EQ(sight.onto, 1.0);
}

TEST(RangeProfile, knowsNothingBehindSomething) {
  const Sight sight = lookAt(around(1.0F), {3.0, 0.0}, 0.2);
  EXPECT_DOUBLE_EQ(sight.through + sight.onto, 0.0);
}

TEST(RangeProfile, infinityIsFreeAndNanIsUnknown) {
  EXPECT_DOUBLE_EQ(lookAt(around(std::numeric_limits<float>::infinity()), {3.0, 0.0}, 0.2).through, 1.0);
  EXPECT_DOUBLE_EQ(lookAt(around(std::nanf("")), {3.0, 0.0}, 0.2).through, 0.0);
}

TEST(RangeProfile, knowsNothingBesideTheViewAndBeyondItsRange) {
  RangeProfile narrow = around(9.0F);
  narrow.angle_min = -0.5;
  narrow.angle_increment = 0.01;
  narrow.ranges.resize(101);
  EXPECT_DOUBLE_EQ(lookAt(narrow, {3.0, 0.0}, 0.2).through, 1.0);
  EXPECT_DOUBLE_EQ(lookAt(narrow, {0.0, 3.0}, 0.2).through, 0.0);
  EXPECT_DOUBLE_EQ(lookAt(narrow, {-3.0, 0.0}, 0.2).through, 0.0);
  const Eigen::Vector2d edge(3.0 * std::cos(0.5), 3.0 * std::sin(0.5));
  EXPECT_NEAR(lookAt(narrow, edge, 0.2).through, 0.5, 0.1) << "half in view";
  EXPECT_DOUBLE_EQ(lookAt(around(9.0F), {9.9, 0.0}, 0.2).through, 0.0);
}

TEST(RangeProfile, holdsAcrossTheSeam) {
  EXPECT_DOUBLE_EQ(lookAt(around(5.0F), {-3.0, 0.0}, 0.3).through, 1.0);
}

}  // namespace
}  // namespace sarn_perception
