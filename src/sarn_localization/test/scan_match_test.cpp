// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/scan_match.h"

#include <gtest/gtest.h>

#include "drawn_map.h"
#include "sarn_common/angles.h"

namespace sarn_localization {
namespace {

/// A map's cells as scan matching asks for them.
class MapView {
 public:
  explicit MapView(sarn::OccupancyMap map) : map_(std::move(map)) {}
  [[nodiscard]] double resolution() const { return map_.geometry.resolution; }
  [[nodiscard]] double centerX(int x) const { return map_.geometry.center({x, 0}).x(); }
  [[nodiscard]] double centerY(int y) const { return map_.geometry.center({0, y}).y(); }
  [[nodiscard]] int cellX(double x) const {
    return static_cast<int>(std::floor((x - map_.geometry.origin_x) / map_.geometry.resolution));
  }
  [[nodiscard]] int cellY(double y) const {
    return static_cast<int>(std::floor((y - map_.geometry.origin_y) / map_.geometry.resolution));
  }
  [[nodiscard]] double occupancy(int x, int y) const {
    if (!map_.geometry.contains({x, y})) return 0.5;
    return map_.at({x, y}) == sarn::kMapOccupied ? 0.9 : 0.1;
  }

 private:
  sarn::OccupancyMap map_;
};

/// Only the surfaces of the room's walls, as a scan draws them.
sarn::OccupancyMap surfaces(const sarn::OccupancyMap& room) {
  sarn::OccupancyMap map = room;
  for (int y = 0; y < room.geometry.height; ++y) {
    for (int x = 0; x < room.geometry.width; ++x) {
      bool beside_free = false;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        const sarn::CellIndex other{x + dx, y + dy};
        beside_free = beside_free || (room.geometry.contains(other) && room.at(other) == sarn::kMapFree);
      }
      if (!beside_free) map.at({x, y}) = sarn::kMapFree;
    }
  }
  return map;
}

std::vector<Eigen::Vector2d> endsOf(const PlanarScan& scan) {
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    const auto range = static_cast<double>(scan.ranges[i]);
    ends.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return ends;
}

const Eigen::Vector3d kWide(0.3, 0.3, 0.2);

TEST(ScanMatch, findsThePoseFromBesideIt) {
  const WallDistance walls(unevenRoom());
  const MapView map(surfaces(unevenRoom()));
  const sarn::Pose2D truth{4.0, 2.4, 0.7};
  const auto ends = endsOf(idealScan(walls, truth, 6.0, 240));
  for (const sarn::Pose2D& off : {sarn::Pose2D{0.08, 0.0, 0.0}, sarn::Pose2D{0.0, -0.08, 0.0},
                                  sarn::Pose2D{0.0, 0.0, 0.04}, sarn::Pose2D{-0.05, 0.05, -0.03}}) {
    const ScanMatch match = matchScan(map, ends, truth * off, kWide, {});
    EXPECT_LT((match.pose.position() - truth.position()).norm(), 0.03);
    EXPECT_NEAR(match.pose.theta, truth.theta, 0.01);
  }
}

TEST(ScanMatch, isNotTurnedByTheWayItIsDrawn) {
  const WallDistance walls(unevenRoom());
  const MapView map(surfaces(unevenRoom()));
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    const sarn::Pose2D truth{3.0 + 0.07 * i, 1.3 + 0.03 * i, 0.5 * i};
    const ScanMatch match = matchScan(map, endsOf(idealScan(walls, truth, 1.0, 160)), truth, kWide, {});
    sum += sarn::angleDifference(truth.theta, match.pose.theta);
  }
  EXPECT_NEAR(sum / 12.0, 0.0, 0.003);
}

TEST(ScanMatch, leavesToTheOdometryWhatAScanCannotTell) {
  // One straight wall, seen squarely: it tells the distance, and nothing about the place along it.
  std::vector<std::string> rows(80, std::string(200, '.'));
  rows[10] = std::string(200, '#');
  const MapView map(drawnMap(rows, 0.05));
  const WallDistance walls(drawnMap(rows, 0.05));
  const sarn::Pose2D truth{5.0, 1.5, 0.5 * sarn::kPi};
  const auto ends = endsOf(idealScan(walls, truth, 1.0, 120));
  const Eigen::Vector3d odometry(0.02, 0.02, 0.01);
  const ScanMatch match = matchScan(map, ends, {5.04, 1.46, 0.5 * sarn::kPi}, odometry, {});
  EXPECT_NEAR(match.pose.x, 5.04, 0.005) << "along the wall";
  EXPECT_NEAR(match.pose.y, 1.5, 0.03) << "towards it";
  EXPECT_GT(std::sqrt(match.covariance(0, 0)), 0.9 * odometry.x());
  EXPECT_LT(std::sqrt(match.covariance(1, 1)), 0.5 * odometry.y());
}

TEST(ScanMatch, staysWithTheOdometryWhereNothingIsDrawn) {
  const MapView map(drawnMap(std::vector<std::string>(40, std::string(40, '?')), 0.05));
  const ScanMatch match = matchScan(map, {{1.0, 0.0}, {1.0, 0.1}}, {0.5, 0.5, 0.1}, kWide, {});
  EXPECT_EQ(match.pose.x, 0.5);
  EXPECT_EQ(match.pose.theta, 0.1);
  EXPECT_NEAR(match.covariance(2, 2), 0.04, 1e-9);
}

TEST(ScanMatch, isLikelierOnTheRightPlace) {
  const WallDistance walls(unevenRoom());
  const MapView map(surfaces(unevenRoom()));
  const sarn::Pose2D truth{4.0, 2.4, 0.7};
  const auto ends = endsOf(idealScan(walls, truth, 6.0, 240));
  const double right = matchScan(map, ends, truth, kWide, {}).log_likelihood;
  EXPECT_GT(right, matchScan(map, ends, {3.2, 2.0, 0.7}, {0.01, 0.01, 0.01}, {}).log_likelihood + 50.0);
}

TEST(OnePerCell, takesTheMeansOfNeighbours) {
  const auto means =
      onePerCell({{1.0, 0.0}, {1.0, 0.02}, {1.0, 0.04}, {1.0, 0.06}, {3.0, 0.0}, {1.0, 0.06}}, 0.05);
  ASSERT_EQ(means.size(), 4U);
  EXPECT_NEAR(means[0].y(), 0.02, 1e-12);
  EXPECT_NEAR(means[1].y(), 0.06, 1e-12);
  EXPECT_NEAR(means[2].x(), 3.0, 1e-12);
  EXPECT_NEAR(means[3].x(), 1.0, 1e-12) << "neighbours only";
  EXPECT_TRUE(onePerCell({}, 0.05).empty());
}

/// Four times the beams meet the same cells: they are hardly surer of the pose.
TEST(OnePerCell, beamsThatMeetTheSameCellsCountOnce) {
  const WallDistance walls(unevenRoom());
  const MapView map(surfaces(unevenRoom()));
  const sarn::Pose2D truth{4.0, 2.4, 0.7};
  const auto sigmaOf = [&](std::size_t beams, double cell) {
    const auto ends = onePerCell(endsOf(idealScan(walls, truth, 1.0, beams)), cell);
    return std::sqrt(matchScan(map, ends, truth, kWide, {}).covariance(2, 2));
  };
  EXPECT_NEAR(sigmaOf(4000, 0.05), sigmaOf(1000, 0.05), 0.1 * sigmaOf(1000, 0.05));
  EXPECT_LT(sigmaOf(4000, 1e-4), 0.6 * sigmaOf(1000, 1e-4)) << "the beams are a test at all";
}

}  // namespace
}  // namespace sarn_localization
