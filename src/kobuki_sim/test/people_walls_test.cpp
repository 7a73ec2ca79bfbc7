// SPDX-License-Identifier: BSD-3-Clause
// People and walls: sliding, sight, outlines, ways.
#include <gtest/gtest.h>

#include <cmath>

#include "drawn_map.h"
#include "kobuki_sim/people/router.h"
#include "kobuki_sim/people/walking_space.h"
#include "kobuki_sim/people/wall_index.h"
#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kRadius = 0.25;  // [m]

double clearance(const StaticMap& map, const Vector2d& p) {
  const auto wall = map.nearestWall(p, 5.0);
  return wall ? wall->distance : 5.0;
}

StaticMap thinWall() {  // 4 m x 4 m; a wall of one cell along y = 2 m, closed to both sides
  std::vector<std::string> rows(40, std::string(40, '.'));
  rows[19] = std::string(40, '#');
  return drawnMap(rows, 0.1);
}

TEST(MoveAmongWalls, isFreeInTheOpen) {
  EXPECT_EQ(moveAmongWalls(nullptr, {1.0, 2.0}, {0.5, -0.5}, kRadius), Vector2d(1.5, 1.5));
  const StaticMap map = thinWall();
  EXPECT_EQ(moveAmongWalls(&map, {2.0, 0.5}, {0.1, 0.1}, kRadius), Vector2d(2.1, 0.6));
}

TEST(MoveAmongWalls, neverTunnelsThroughAThinWallHoweverFar) {
  const StaticMap map = thinWall();
  for (const double far : {0.05, 0.3, 1.0, 3.0, 50.0}) {
    const Vector2d end = moveAmongWalls(&map, {2.0, 1.5}, {0.0, far}, kRadius);
    EXPECT_LT(end.y(), 2.0);
    EXPECT_GE(clearance(map, end), kRadius - 1e-6);
  }
}

TEST(MoveAmongWalls, slidesAlongAWall) {
  const StaticMap map = thinWall();
  const Vector2d end = moveAmongWalls(&map, {1.0, 1.7}, {0.1, 0.1}, kRadius);
  EXPECT_NEAR(end.x(), 1.1, 0.01);
  EXPECT_NEAR(clearance(map, end), kRadius, 1e-5);
}

TEST(MoveAmongWalls, standsInACornerAndGetsOutAgain) {
  const StaticMap map = drawnMap({"########", "#......#", "#......#", "#......#", "########"}, 0.2);
  Vector2d p(0.5, 0.5);
  for (int i = 0; i < 200; ++i) p = moveAmongWalls(&map, p, {-0.02, -0.02}, kRadius);
  EXPECT_GE(clearance(map, p), kRadius - 1e-6);
  EXPECT_LT((p - Vector2d(0.45, 0.45)).norm(), 0.01);
  for (int i = 0; i < 10; ++i) p = moveAmongWalls(&map, p, {0.02, 0.02}, kRadius);
  EXPECT_GT(p.x(), 0.6);
}

TEST(MoveAmongWalls, bodyThatOverlapsAWallGetsNoDeeperAndCanLeave) {
  const StaticMap map = thinWall();
  const Vector2d stuck(2.0, 1.85);  // 0.05 m from the wall with a radius of 0.25 m
  EXPECT_GE(clearance(map, moveAmongWalls(&map, stuck, {0.0, 0.1}, kRadius)), clearance(map, stuck) - 1e-6);
  EXPECT_NEAR(moveAmongWalls(&map, stuck, {0.0, -0.1}, kRadius).y(), 1.75, 1e-6);
}

TEST(MoveAmongWalls, randomPushesInAMazeNeverEnterAWall) {
  const StaticMap map = drawnMap({"####################",  //
                                  "#....#........#....#",  //
                                  "#....#..####..#....#",  //
                                  "#.......#..........#",  //
                                  "#..##...#....#.....#",  //
                                  "#...#........##....#",  //
                                  "#....#.............#",  //
                                  "####################"},
                                 0.5);
  RandomStream random(1, "maze");
  Vector2d p(0.9, 3.0);
  Vector2d drift(0.0, 0.0);
  for (int i = 0; i < 20000; ++i) {
    if (i % 50 == 0) drift = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)};
    const Vector2d before = p;
    p = moveAmongWalls(&map, p, drift + Vector2d(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)),
                       kRadius);
    ASSERT_GE(clearance(map, p), kRadius - 1e-6) << "step " << i;
    ASSERT_TRUE(map.segmentFree(before, p)) << "step " << i;
  }
}

TEST(CanWalkStraight, needsRoomForTheWholeBody) {
  const StaticMap map = drawnMap({"....#....", "....#....", ".........", "....#....", "....#...."}, 0.4);
  EXPECT_TRUE(canWalkStraight(&map, {0.4, 1.0}, {3.2, 1.0}, 0.19));
  EXPECT_FALSE(canWalkStraight(&map, {0.4, 1.0}, {3.2, 1.0}, 0.21));
  EXPECT_FALSE(canWalkStraight(&map, {0.4, 0.4}, {3.2, 0.4}, 0.1));
}

TEST(WallOutlines, boxBecomesFourEdgesThatFaceOutwards) {
  const StaticMap map = drawnMap({".....", ".##..", ".##..", "....."}, 0.5);
  const auto outlines = wallOutlines(map, 0.3);
  ASSERT_EQ(outlines.size(), 1U);
  EXPECT_EQ(outlines[0].size(), 4U);
  const auto edges = wallEdges(outlines);
  int facing = 0;
  for (const WallEdge& edge : edges) facing += edge.faces({0.1, 1.0}) ? 1 : 0;
  EXPECT_EQ(facing, 1);
  for (const WallEdge& edge : edges) EXPECT_FALSE(edge.faces({1.0, 1.0}));  // the middle of the box
}

TEST(WallOutlines, roomHasAnOutlineInsideAndOneOutside) {
  const StaticMap map = drawnMap({"#####", "#...#", "#...#", "#####"}, 0.5);
  EXPECT_EQ(wallOutlines(map, 0.3).size(), 2U);
  const auto edges = wallEdges(wallOutlines(map, 0.3));
  int facing = 0;
  for (const WallEdge& edge : edges) facing += edge.faces({1.25, 1.0}) ? 1 : 0;
  EXPECT_EQ(facing, 4);  // from inside one sees the four walls of the room
}

TEST(WallOutlines, stayWithinTheToleranceOfTheCells) {
  RandomStream random(2, "outline");
  std::vector<std::string> rows(20, std::string(20, '.'));
  for (auto& row : rows) {
    for (char& c : row) c = random.uniform() < 0.3 ? '#' : '.';
  }
  const StaticMap map = drawnMap(rows, 0.1);
  for (const auto& outline : wallOutlines(map, 0.075)) {
    for (const Vector2d& point : outline)
      EXPECT_LT(clearance(map, point), 1e-9);  // corners are corners of cells
  }
}

TEST(WallIndex, findsWhatBruteForceFinds) {
  RandomStream random(3, "index");
  std::vector<std::string> rows(60, std::string(60, '.'));
  for (auto& row : rows) {
    for (char& c : row) c = random.uniform() < 0.02 ? '#' : '.';
  }
  const StaticMap map = drawnMap(rows, 0.1);
  const WallIndex index(wallEdges(wallOutlines(map, 0.05)), 1.5);
  std::vector<WallEdge> found;
  for (int i = 0; i < 100; ++i) {
    const Vector2d p(random.uniform(-2.0, 8.0), random.uniform(-2.0, 8.0));
    std::vector<double> expected;
    for (const WallEdge& edge : index.edges()) {
      if (edge.faces(p) && edge.squaredDistance(p) < 1.2 * 1.2) expected.push_back(edge.squaredDistance(p));
    }
    std::sort(expected.begin(), expected.end());
    if (expected.size() > 9) expected.resize(9);
    index.nearest(p, 1.2, 9, found);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].squaredDistance(p), expected[k]);
  }
}

double lengthOf(const std::vector<Vector2d>& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += (way[i] - way[i - 1]).norm();
  return sum;
}

TEST(Router, goesStraightWhereItCan) {
  const StaticMap map = thinWall();
  const Router router(map, {}, {});
  std::vector<Vector2d> way;
  ASSERT_TRUE(router.route({0.5, 0.5}, {3.5, 1.0}, kRadius, {}, way));
  EXPECT_EQ(way.size(), 2U);
}

TEST(Router, goesAroundAWallWithRoomForTheBody) {
  std::vector<std::string> rows(60, std::string(60, '.'));
  for (std::size_t y = 10; y < 60; ++y) rows[y][30] = '#';  // open at the top
  const StaticMap map = drawnMap(rows, 0.1);
  const Router router(map, {}, {});
  std::vector<Vector2d> way;
  ASSERT_TRUE(router.route({1.0, 3.0}, {5.0, 3.0}, kRadius, {}, way));
  EXPECT_GE(way.size(), 3U);
  for (std::size_t i = 1; i < way.size(); ++i)
    EXPECT_TRUE(canWalkStraight(&map, way[i - 1], way[i], kRadius - 0.01));
  // Tight around the wall's end at (3.05, 5.0), which is the shortest way but for the rim kept.
  const double shortest = 2.0 * std::hypot(2.05, 2.0);
  EXPECT_GT(lengthOf(way), shortest);
  EXPECT_LT(lengthOf(way), 1.25 * shortest);
}

TEST(Router, saysWhenThereIsNoWay) {
  const StaticMap map = drawnMap({"########", "#......#", "#......#", "########"}, 0.5);
  const Router router(map, {{6.0, 1.0}}, {});
  std::vector<Vector2d> way{{7.0, 7.0}};
  EXPECT_FALSE(router.route({1.0, 1.0}, {6.0, 1.0}, kRadius, {}, way));
  EXPECT_EQ(way.size(), 1U);
}

TEST(Router, walksAroundStandingPeople) {
  const StaticMap open;
  const Router router(open, {{0.0, 0.0}, {4.0, 0.0}}, {{{2.0, 0.0}, 0.35}});
  std::vector<Vector2d> way;
  ASSERT_TRUE(router.route({0.0, 0.0}, {4.0, 0.0}, kRadius, {}, way));
  ASSERT_GE(way.size(), 3U);
  EXPECT_FALSE(router.sees({0.0, 0.0}, {4.0, 0.0}, kRadius));
  EXPECT_LT(lengthOf(way), 4.5);
}

}  // namespace
}  // namespace kobuki_sim
