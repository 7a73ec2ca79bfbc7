// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/visibility.h"

#include <gtest/gtest.h>

namespace sarn_perception {
namespace {

/// Rows from the top (largest y), 1 m a cell.
sarn::OccupancyMap drawn(const std::vector<std::string>& rows) {
  const int height = static_cast<int>(rows.size());
  sarn::OccupancyMap map({static_cast<int>(rows[0].size()), height, 1.0, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      if (rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)] == '#') {
        map.at({x, y}) = sarn::kMapOccupied;
      }
    }
  }
  return map;
}

TEST(LineOfSight, endsAtWalls) {
  const auto map = drawn({".....",  //
                          "..#..",  //
                          "....."});
  EXPECT_FALSE(lineOfSight(map, {0.5, 1.5}, {4.5, 1.5}));
  EXPECT_FALSE(lineOfSight(map, {4.5, 1.5}, {0.5, 1.5}));
  EXPECT_TRUE(lineOfSight(map, {0.5, 0.5}, {4.5, 0.5}));
  EXPECT_TRUE(lineOfSight(map, {0.5, 1.5}, {2.5, 1.5})) << "the end's own cell does not count";
  EXPECT_TRUE(lineOfSight({}, {0.5, 1.5}, {4.5, 1.5})) << "no map, no walls";
  EXPECT_TRUE(lineOfSight(map, {-5.0, 5.0}, {9.0, 5.0})) << "no walls outside the map";
}

TEST(CrossesDisc, tellsDiscsBetweenFromOthers) {
  const Disc disc{{2.0, 0.0}, 0.5};
  EXPECT_TRUE(crossesDisc({0.0, 0.0}, {4.0, 0.0}, disc));
  EXPECT_TRUE(crossesDisc({0.0, 0.4}, {4.0, 0.4}, disc));
  EXPECT_FALSE(crossesDisc({0.0, 0.6}, {4.0, 0.6}, disc));
  EXPECT_FALSE(crossesDisc({0.0, 0.0}, {1.0, 0.0}, disc)) << "ends before it";
  EXPECT_FALSE(crossesDisc({2.1, 0.0}, {4.0, 0.0}, disc)) << "starts in it";
}

TEST(VisibleShare, fallsAsAnotherPersonMovesInFront) {
  const Disc target{{6.0, 0.0}, 0.25};
  double last = 1.0;
  EXPECT_DOUBLE_EQ(visibleShare({}, {0.0, 0.0}, target, {}), 1.0);
  for (const double y : {0.6, 0.4, 0.3, 0.2, 0.1, 0.0}) {
    const double share = visibleShare({}, {0.0, 0.0}, target, {{{3.0, y}, 0.25}});
    EXPECT_LE(share, last) << y;
    EXPECT_DOUBLE_EQ(share, visibleShare({}, {0.0, 0.0}, target, {{{3.0, -y}, 0.25}})) << "symmetric";
    last = share;
  }
  EXPECT_DOUBLE_EQ(last, 0.0);
}

TEST(VisibleShare, isZeroBehindAWall) {
  const auto map = drawn({"..#..",  //
                          "..#..",  //
                          "..#.."});
  EXPECT_DOUBLE_EQ(visibleShare(map, {0.5, 1.5}, {{4.5, 1.5}, 0.25}, {}), 0.0);
  EXPECT_DOUBLE_EQ(visibleShare(map, {0.5, 1.5}, {{1.5, 1.5}, 0.25}, {}), 1.0);
}

}  // namespace
}  // namespace sarn_perception
