// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/group_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace social_costmap {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double nearestOf(const std::vector<Polygon>& space, const Eigen::Vector2d& point) {
  double nearest = 1e9;
  for (const Polygon& piece : space) nearest = std::min(nearest, distanceTo(piece, point));
  return nearest;
}

TEST(GroupSpace, hullIsConvexAndHoldsAllPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  for (int round = 0; round < 200; ++round) {
    Points points;
    for (unsigned i = 0; i < 1 + random() % 12; ++i) points.emplace_back(u(random), u(random));
    const Points all = points;
    Polygon hull;
    convexHull(points, hull);
    for (const auto& point : all) EXPECT_LT(distanceTo(hull, point), 1e-9);
    for (std::size_t i = 0; hull.size() > 2 && i < hull.size(); ++i) {
      const auto& a = hull[i];
      const Eigen::Vector2d ab = hull[(i + 1) % hull.size()] - a;
      const Eigen::Vector2d ac = hull[(i + 2) % hull.size()] - a;
      EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);
    }
  }
}

TEST(GroupSpace, distanceIsZeroInsideAndEuclideanOutside) {
  const Polygon square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_DOUBLE_EQ(0.0, distanceTo(square, {0.5, 0.5}));
  EXPECT_DOUBLE_EQ(0.5, distanceTo(square, {0.5, -0.5}));
  EXPECT_DOUBLE_EQ(std::sqrt(2.0), distanceTo(square, {2.0, 2.0}));
}

TEST(GroupSpace, linksNeighboursOfAQueueInAnyOrder) {
  const Points queue{{3, 0}, {0, 0}, {2, 0}, {1, 0}, {9, 0}};
  const auto links = neighbourLinks(queue, 2.0);
  EXPECT_EQ(3U, links.size()) << "the one at 9 m stands alone";
  for (const auto& [a, b] : links) EXPECT_DOUBLE_EQ(1.0, (queue[a] - queue[b]).norm());
}

TEST(GroupSpace, spanningTreeIsMinimal) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(0.0, 3.0);
  for (int round = 0; round < 50; ++round) {
    Points p;
    for (int i = 0; i < 6; ++i) p.emplace_back(u(random), u(random));
    double prim = 0.0;
    for (const auto& [a, b] : neighbourLinks(p, 100.0)) prim += (p[a] - p[b]).norm();
    // Kruskal: shortest edges first, unless they close a circle.
    std::vector<std::pair<double, std::pair<int, int>>> edges;
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) {
        edges.push_back({(p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]).norm(), {i, j}});
      }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<int> of{0, 1, 2, 3, 4, 5};
    double kruskal = 0.0;
    for (const auto& [length, edge] : edges) {
      const int a = of[static_cast<std::size_t>(edge.first)];
      const int b = of[static_cast<std::size_t>(edge.second)];
      if (a == b) continue;
      std::replace(of.begin(), of.end(), a, b);
      kruskal += length;
    }
    EXPECT_NEAR(kruskal, prim, 1e-9);
  }
}

TEST(GroupSpace, fillsTheCircleOfATalkingGroup) {
  Points circle;
  for (int i = 0; i < 5; ++i) circle.emplace_back(0.9 * std::cos(1.2566 * i), 0.9 * std::sin(1.2566 * i));
  const auto space = groupSpace(circle, circle, 2.0);
  EXPECT_DOUBLE_EQ(0.0, nearestOf(space, {0.0, 0.0}));
  EXPECT_GT(nearestOf(space, {2.0, 0.0}), 1.0);
}

TEST(GroupSpace, doesNotFillTheBendOfAQueue) {
  const Points bent{{0, 0}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}};
  const auto space = groupSpace(bent, bent, 2.0);
  EXPECT_GT(nearestOf(space, {1.2, 0.9}), 0.9);
  EXPECT_LT(nearestOf(space, {0.0, 1.5}), 1e-9);
}

TEST(GroupSpace, coversTheWayOfAWalkingPair) {
  const auto space = groupSpace({{0, 0}, {0, 1}}, {{1, 0}, {1, 1}}, 2.0);
  ASSERT_EQ(1U, space.size());
  EXPECT_DOUBLE_EQ(0.0, nearestOf(space, {0.5, 0.5}));
}

TEST(GroupSpace, isEmptyForOneAndForPeopleFarApart) {
  EXPECT_TRUE(groupSpace({{0, 0}}, {{0, 0}}, 2.0).empty());
  EXPECT_TRUE(groupSpace({}, {}, 2.0).empty());
  EXPECT_TRUE(groupSpace({{0, 0}, {5, 0}}, {{0, 0}, {5, 0}}, 2.0).empty());
}

TEST(GroupSpace, standsMembersAtOnePoint) {
  const auto space = groupSpace({{1, 1}, {1, 1}, {1, 1}}, {{1, 1}, {1, 1}, {1, 1}}, 2.0);
  EXPECT_LT(nearestOf(space, {1, 1}), 1e-9);
}

}  // namespace
}  // namespace social_costmap
