// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/segments.h"

#include <gtest/gtest.h>

namespace sarn {
namespace {

TEST(Segments, distanceIsToTheNearestPointBetweenTheEnds) {
  const Eigen::Vector2d a(1.0, 0.0);
  const Eigen::Vector2d b(4.0, 0.0);
  EXPECT_DOUBLE_EQ(distanceToSegment({2.0, 3.0}, a, b), 3.0) << "beside it";
  EXPECT_DOUBLE_EQ(distanceToSegment({-2.0, 4.0}, a, b), 5.0) << "before a";
  EXPECT_DOUBLE_EQ(distanceToSegment({7.0, -4.0}, a, b), 5.0) << "beyond b";
  EXPECT_DOUBLE_EQ(distanceToSegment({2.0, 3.0}, b, a), 3.0) << "either way round";
  EXPECT_DOUBLE_EQ(distanceToSegment({1.0, 2.0}, a, a), 2.0) << "a segment that is one point";
}

}  // namespace
}  // namespace sarn
