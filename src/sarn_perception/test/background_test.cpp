// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/background.h"

#include <gtest/gtest.h>

#include "small_world.h"

namespace sarn_perception {
namespace {

std::vector<SeenPoint> pointsOf(const PlanarScan& scan) {
  std::vector<SeenPoint> points;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double bearing = static_cast<double>(scan.angle_min) +
                           static_cast<double>(i) * static_cast<double>(scan.angle_increment);
    const auto range = static_cast<double>(scan.ranges[i]);
    points.push_back({{range * std::cos(bearing), range * std::sin(bearing)}, 0.01});
  }
  return points;
}

TEST(Background, measuresToTheWallsEdge) {
  Background background({});
  background.setMap(room());
  EXPECT_NEAR(background.wallDistance({0.7, 3.0}), 0.5, 0.03);
  EXPECT_NEAR(background.wallDistance({0.1, 3.0}), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(background.wallDistance({3.0, 3.0}), Background::kReach);
  EXPECT_DOUBLE_EQ(background.wallDistance({-50.0, 3.0}), Background::kReach);
  EXPECT_DOUBLE_EQ(background.wallDistance({std::nan(""), 3.0}), Background::kReach);
}

TEST(Background, toleratesMoreFartherAwayAndWithNoise) {
  BackgroundParams params;
  params.tolerance = 0.1;
  params.tolerance_per_m = 0.02;
  params.noise_factor = 2.0;
  Background background(params);
  background.setMap(room());
  const Eigen::Vector2d point(0.37, 3.0);  // 0.17 m from the wall
  EXPECT_FALSE(background.explains(point, 1.0, 0.0));
  EXPECT_TRUE(background.explains(point, 5.0, 0.0));
  EXPECT_TRUE(background.explains(point, 1.0, 0.05));
}

TEST(Background, undoesTheErrorOfTheLocalisation) {
  Background background({});
  background.setMap(room());
  const sarn::Pose2D truth{2.0, 2.5, 0.7};
  // People stand in the view; they must not pull.
  std::vector<Disc> discs = legsAt({3.5, 3.5});
  for (const Disc& leg : legsAt({1.0, 4.0})) discs.push_back(leg);
  const auto points = pointsOf(scanOf(truth, discs));
  const sarn::Pose2D fitted = background.fit(points, {2.08, 2.42, 0.75});
  EXPECT_NEAR(fitted.x, truth.x, 0.02);
  EXPECT_NEAR(fitted.y, truth.y, 0.02);
  EXPECT_NEAR(fitted.theta, truth.theta, 0.01);
}

/// What a camera with this pose sees of a map, and all of which must be explained although the localisation
/// errs by two to two and a half of its deviations.
void expectAllExplained(const sarn::OccupancyMap& map, const sarn::Pose2D& truth) {
  Background background({});
  background.setMap(map);
  const auto points = pointsOf(scanOf(truth, map, 58, sarn::kPi / 3.0));  // as narrow a view as the camera's
  for (const double dx : {-0.1, 0.1}) {
    for (const double dy : {-0.1, 0.1}) {
      for (const double turn : {-0.05, 0.05}) {
        const sarn::Pose2D fitted = background.fit(points, {truth.x + dx, truth.y + dy, truth.theta + turn});
        int unexplained = 0;
        for (const SeenPoint& point : points) {
          unexplained +=
              background.explains(fitted * point.position, point.position.norm(), point.sigma) ? 0 : 1;
        }
        EXPECT_EQ(unexplained, 0) << "from " << truth.x << ", " << truth.y << ", " << truth.theta << " by "
                                  << dx << " m, " << dy << " m, " << turn << " rad";
      }
    }
  }
}

/// Fitted at once as finely as in the end, a wall may be taken for another, and its far end for a person.
TEST(Background, undoesErrorsOfTwiceTheirDeviation) { expectAllExplained(room(), {1.5, 1.5, 0.4}); }

/// Fitted from the localisation's pose only, however coarsely at first, it ends in a local optimum here: the
/// far end of a cabinet was a person for 1.6 s in an empty office.
TEST(Background, takesTheLikeliestOfItsLocalOptima) {
  expectAllExplained(room(), {3.8, 5.3, -1.6});
  expectAllExplained(room(), {1.0, 4.9, -1.4});
  expectAllExplained(room(), {0.7, 2.2, -0.6});
  sarn::OccupancyMap furnished = room();
  addBox({3.4, 0.6}, {4.0, 1.2}, furnished);
  addBox({2.6, 1.8}, {3.2, 3.0}, furnished);
  expectAllExplained(furnished, {2.7, 1.0, 0.5});
}

TEST(Background, leavesWhoStandsBesideFurniture) {
  sarn::OccupancyMap furnished = room();
  addBox({3.6, 2.6}, {4.6, 4.0}, furnished);
  Background background({});
  background.setMap(furnished);
  const sarn::Pose2D truth{1.5, 2.6, 0.1};
  PlanarScan scan = scanOf(truth, furnished, 58, sarn::kPi / 3.0);
  const PlanarScan people = scanOf(truth, legsAt({3.2, 3.0}), 58, sarn::kPi / 3.0);  // 0.4 m before it
  std::vector<std::size_t> legs;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (people.ranges[i] < scan.ranges[i] - 0.2F) legs.push_back(i);
    scan.ranges[i] = std::min(scan.ranges[i], people.ranges[i]);
  }
  ASSERT_GE(legs.size(), 4U);
  const auto points = pointsOf(scan);
  for (const double shift : {-0.1, 0.1}) {
    for (const double turn : {-0.05, 0.05}) {
      const sarn::Pose2D fitted =
          background.fit(points, {truth.x + shift, truth.y - shift, truth.theta + turn});
      for (const std::size_t i : legs) {
        const Eigen::Vector2d& place = points[i].position;
        EXPECT_FALSE(background.explains(fitted * place, place.norm(), 0.01)) << shift << " m, " << turn;
      }
    }
  }
}

TEST(Background, trustsTheLocalisationWhereNoWallIsSeen) {
  Background background({});
  background.setMap(room());
  const sarn::Pose2D pose{3.0, 3.0, 0.1};
  const sarn::Pose2D fitted = background.fit({{{0.8, 0.0}, 0.01}, {{0.8, 0.1}, 0.01}}, pose);
  EXPECT_NEAR(fitted.x, pose.x, 1e-6);
  EXPECT_NEAR(fitted.y, pose.y, 1e-6);
  EXPECT_NEAR(fitted.theta, pose.theta, 1e-6);
}

TEST(Background, knowsWhatTheMapDoesNotKnow) {
  Background background({});
  EXPECT_FALSE(background.hasMap());
  EXPECT_TRUE(background.unknown({1.0, 1.0}));
  sarn::OccupancyMap map = room();
  map.at({60, 60}) = sarn::kMapUnknown;
  background.setMap(map);
  EXPECT_TRUE(background.unknown({3.01, 3.01}));
  EXPECT_FALSE(background.unknown({2.0, 2.0}));
  EXPECT_TRUE(background.unknown({-1.0, 2.0}));
}

}  // namespace
}  // namespace sarn_perception
