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

/// Fitted at once as finely as in the end, a wall may be taken for another, and its far end for a person.
TEST(Background, undoesErrorsOfTwiceTheirDeviation) {
  Background background({});
  background.setMap(room());
  const sarn::Pose2D truth{1.5, 1.5, 0.4};
  const auto points = pointsOf(scanOf(truth, {}, 58, sarn::kPi / 3.0));  // as narrow a view as the camera's
  for (const double dx : {-0.1, 0.1}) {
    for (const double dy : {-0.1, 0.1}) {
      for (const double turn : {-0.05, 0.05}) {
        const sarn::Pose2D fitted = background.fit(points, {truth.x + dx, truth.y + dy, truth.theta + turn});
        for (const SeenPoint& point : points) {
          EXPECT_TRUE(background.explains(fitted * point.position, point.position.norm(), point.sigma))
              << dx << " m, " << dy << " m, " << turn << " rad";
        }
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
