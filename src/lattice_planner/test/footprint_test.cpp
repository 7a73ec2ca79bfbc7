// SPDX-License-Identifier: BSD-3-Clause
// Robots that are not round: their outline, which cells it touches, and what they plan where there is little
// room.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "lattice_planner/blocked_cells.h"
#include "lattice_planner/footprint.h"
#include "lattice_planner/footprint_check.h"
#include "lattice_planner/footprint_masks.h"
#include "world.h"

namespace lattice_planner::testing {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr const char* kLong = "[[0.5, 0.2], [-0.5, 0.2], [-0.5, -0.2], [0.5, -0.2]]";  // 1 m x 0.4 m

PlannerParams longRobot() {
  PlannerParams params;
  params.table_radius = 0.6;
  params.footprint = kLong;
  return params;
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + share * (b - a) - p).norm();
}

bool inside(const Points& polygon, const Eigen::Vector2d& p) {
  bool result = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto& a = polygon[i];
    const auto& b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) result = !result;
  }
  return result;
}

/// Distance of a point to a polygon, 0 inside.
double distanceTo(const Points& polygon, const Eigen::Vector2d& p) {
  if (inside(polygon, p)) return 0.0;
  double least = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    least = std::min(least, distanceToSegment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  return least;
}

Points placed(const Points& corners, const sarn::Pose2D& pose) {
  Points all;
  for (const auto& corner : corners) all.push_back(pose * corner);
  return all;
}

/// True when a polygon reaches into a cell, looked at on a fine raster of the cell.
bool touches(const Points& polygon, const Eigen::Vector2d& center, double edge) {
  constexpr int kFine = 9;
  for (int y = 0; y < kFine; ++y) {
    for (int x = 0; x < kFine; ++x) {
      const Eigen::Vector2d p =
          center + edge * Eigen::Vector2d((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
      if (inside(polygon, p)) return true;
    }
  }
  return false;
}

TEST(Footprint, isReadAsCostmap2dHasIt) {
  const Footprint footprint = parseFootprint(kLong);
  ASSERT_EQ(footprint.corners.size(), 4U);
  EXPECT_DOUBLE_EQ(footprint.corners[1].x(), -0.5);
  EXPECT_DOUBLE_EQ(footprint.inscribed_radius, 0.2);
  EXPECT_DOUBLE_EQ(footprint.circumscribed_radius, std::hypot(0.5, 0.2));
  EXPECT_TRUE(parseFootprint("").round());
  EXPECT_TRUE(parseFootprint("[]").round());
  EXPECT_EQ(parseFootprint(toString(footprint)).corners, footprint.corners);
}

TEST(Footprint, saysWhatIsWrongWithIt) {
  for (const char* text :
       {"[[0.1, 0.2], [0.3, 0.4]]", "[[0.1, 0.2], [0.3], [0.2, 0.1]]", "round", "[1, 2, 3]",
        "[[0.5, 0.2], [-0.5, 0.2], [-0.5, .nan]]", "[[0.5, 0.2], [-0.5, x], [-0.5, -0.2]]",
        "[[1.0, 1.0], [2.0, 1.0], [1.0, 2.0]]", "{", "[[20, 20], [-20, 20], [0, -20]]"}) {
    EXPECT_THROW((void)parseFootprint(text), std::invalid_argument) << text;
    PlannerParams params;
    params.footprint = text;
    const auto problems = sarn::problems(params);
    ASSERT_EQ(problems.size(), 1U) << text;
    EXPECT_NE(problems[0].find("footprint"), std::string::npos);
  }
}

// A disc of the inscribed radius around any point of the core lies inside; a point is within r of a convex
// robot exactly if it is within r + inscribed radius of the core's... outside of which it is farther:
// sampled.
TEST(Footprint, coreKeepsTheInscribedRadiusFromTheOutline) {
  for (const char* text : {kLong, "[[0.6, 0.0], [-0.2, 0.3], [-0.2, -0.3]]",
                           "[[0.4, 0.1], [0.2, 0.3], [-0.3, 0.25], [-0.35, -0.2], [0.1, -0.3]]"}) {
    const Footprint footprint = parseFootprint(text);
    const Points core = coreOf(footprint);
    ASSERT_GE(core.size(), 3U);
    for (const auto& p : core) {
      double least = 1e9;
      for (std::size_t i = 0; i < footprint.corners.size(); ++i) {
        least = std::min(least, distanceToSegment(p, footprint.corners[i],
                                                  footprint.corners[(i + 1) % footprint.corners.size()]));
      }
      EXPECT_GE(least, footprint.inscribed_radius - 2e-3) << text;
    }
    EXPECT_LT(distanceTo(core, {0.0, 0.0}), 1e-9) << text;
  }
  const Points segment = coreOf(parseFootprint(kLong));  // of the rectangle: 0.6 m long, hardly any width
  for (const auto& p : segment) {
    EXPECT_NEAR(std::abs(p.x()), 0.3, 1e-9);
    EXPECT_LT(std::abs(p.y()), 2e-3);
  }
}

// Against a raster of the polygon itself: every touched cell is in the mask, and no cell that lies well
// apart.
TEST(FootprintMasks, coverWhatThePolygonTouchesAndLittleMore) {
  std::mt19937 random(3);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (const char* text : {kLong, "[[0.6, 0.0], [-0.2, 0.3], [-0.2, -0.3]]"}) {
    const Footprint footprint = parseFootprint(text);
    for (const double resolution : {0.05, 0.1}) {
      const FootprintMasks masks(footprint.corners, resolution);
      for (int i = 0; i < 60; ++i) {
        const sarn::Pose2D pose{uniform(0.0, resolution), uniform(0.0, resolution),
                                i == 0 ? sarn::kPi : uniform(-7.0, 7.0)};
        const Points polygon = placed(footprint.corners, pose);
        const auto mask = masks.at(pose.x / resolution, pose.y / resolution, pose.theta);
        for (int y = -30; y <= 30; ++y) {
          for (int x = -30; x <= 30; ++x) {
            const int row = y - mask.first_row;
            const bool covered =
                row >= 0 && row < mask.count && x >= mask.rows[row].first && x <= mask.rows[row].last;
            const Eigen::Vector2d center((x + 0.5) * resolution, (y + 0.5) * resolution);
            if (!covered) {
              EXPECT_FALSE(touches(polygon, center, resolution)) << text << " " << x << ", " << y;
            } else {
              // From the cell's centre: half its diagonal and that of the margin.
              EXPECT_LT(distanceTo(polygon, center), std::sqrt(2.0) * (0.5 + 0.5) * resolution)
                  << text << " " << x << ", " << y;
            }
          }
        }
      }
    }
  }
}

TEST(BlockedCells, equalWhatCountingCellByCellGives) {
  std::mt19937 random(11);
  std::array<bool, 256> blocked{};
  blocked[254] = true;
  const Footprint footprint = parseFootprint(kLong);
  const FootprintMasks masks(footprint.corners, 0.05);
  for (const int width : {31, 64, 131}) {
    const sarn::GridGeometry geometry{width, 40, 0.05, 0.0, 0.0};
    std::vector<std::uint8_t> costs(geometry.size(), 0);
    for (int i = 0; i < 12; ++i) costs[random() % costs.size()] = 254;
    BlockedCells cells;
    cells.reset(geometry, costs.data(), blocked, masks.reach());
    for (int i = 0; i < 300; ++i) {
      const sarn::CellIndex cell{static_cast<int>(random() % static_cast<unsigned>(width)),
                                 static_cast<int>(random() % 40U)};
      const auto mask = masks.at(0.3, 0.8, 0.1 * i);
      int count = 0;
      for (int row = 0; row < mask.count; ++row) {
        for (int x = mask.rows[row].first; x <= mask.rows[row].last; ++x) {
          const sarn::CellIndex at{cell.x + x, cell.y + mask.first_row + row};
          count += !geometry.contains(at) || costs[geometry.index(at)] == 254 ? 1 : 0;
        }
      }
      EXPECT_EQ(cells.touched(cell, mask, 1 << 20), count);
      EXPECT_TRUE(count == 0 || cells.near(cell));
      bool any = false;
      for (int y = -masks.reach(); y <= masks.reach(); ++y) {
        for (int x = -masks.reach(); x <= masks.reach(); ++x) {
          const sarn::CellIndex at{cell.x + x, cell.y + y};
          any = any || !geometry.contains(at) || costs[geometry.index(at)] == 254;
        }
      }
      EXPECT_EQ(cells.near(cell), any);
    }
  }
}

/// Two rooms of 2 m x 2.4 m that a corridor joins, 2 m long and `width` wide, lethal walls; inflated by the
/// inscribed radius of the long robot, as its costmap would be.
World corridor(double width) {
  World world = World::room(6.0, 2.4);
  const sarn::GridGeometry g = world.view().geometry;
  std::vector<sarn::CellIndex> walls;
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      const Eigen::Vector2d p = g.center({x, y});
      const bool border = x == 0 || y == 0 || x == g.width - 1 || y == g.height - 1;
      const bool wall = p.x() > 2.0 && p.x() < 4.0 && std::abs(p.y() - 1.2) > 0.5 * width;
      if (border || wall) walls.push_back({x, y});
    }
  }
  for (const auto& cell : walls) {
    const Eigen::Vector2d p = g.center(cell);
    world.paintStatic(p.x(), p.y(), 0.2, sarn::kInscribedObstacle);
  }
  for (const auto& cell : walls) world.setStatic(cell, sarn::kLethalObstacle);
  return world;
}

/// Lethal cells under the robot somewhere along a trajectory, looked at on a raster of the polygon, finely in
/// time.
int collisions(const sarn::TimedTrajectory& trajectory, const World& world, const Points& corners) {
  const sarn::GridGeometry& g = world.view().geometry;
  int count = 0;
  for (double t = trajectory.startTime(); t <= trajectory.endTime(); t += 0.02) {
    const sarn::Pose2D pose = trajectory.sample(t).pose();
    const Points polygon = placed(corners, pose);
    const auto low = g.cellAtUnbounded(pose.x - 0.6, pose.y - 0.6);
    const auto high = g.cellAtUnbounded(pose.x + 0.6, pose.y + 0.6);
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const bool lethal =
            !g.contains({x, y}) || world.view().static_costs[g.index({x, y})] == sarn::kLethalObstacle;
        if (lethal && touches(polygon, g.center({x, y}), 0.8 * g.resolution)) ++count;
      }
    }
  }
  return count;
}

TEST(LongRobot, passesANarrowCorridorLengthwise) {
  LatticePlanner planner(longRobot());
  const World world = corridor(0.7);
  const PlanRequest task = request({1.0, 0.9, 0.5 * sarn::kPi}, {5.0, 1.2, 0.0});
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete) << toString(result.status);
  EXPECT_EQ(collisions(result.trajectory, world, parseFootprint(kLong).corners), 0);
}

TEST(LongRobot, doesNotTurnInACorridorThatIsTooNarrowForIt) {
  LatticePlanner planner(longRobot());
  const World world = corridor(0.7);
  // Across the corridor it fits nowhere; a round robot of its inscribed radius does.
  const PlanRequest across = request({3.0, 1.2, 0.0}, {3.0, 1.2, 0.5 * sarn::kPi});
  EXPECT_EQ(planner.plan(across, world.view()).status, PlanStatus::kGoalOccupied);
  PlannerParams round = longRobot();
  round.footprint = "";
  LatticePlanner centre_only(round);
  const PlanResult turned = centre_only.plan(across, world.view());
  ASSERT_EQ(turned.status, PlanStatus::kComplete);
  EXPECT_GT(collisions(turned.trajectory, world, parseFootprint(kLong).corners), 0);
  // To face back it has to leave the corridor, turn in a room and come in again.
  const PlanRequest back = request({3.0, 1.2, 0.0}, {3.0, 1.2, sarn::kPi});
  const PlanResult result = planner.plan(back, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete) << toString(result.status);
  EXPECT_EQ(collisions(result.trajectory, world, parseFootprint(kLong).corners), 0);
  double farthest = 0.0;
  for (const auto& p : result.trajectory.points) farthest = std::max(farthest, std::abs(p.x - 3.0));
  EXPECT_GT(farthest, 1.0);
  EXPECT_LT(centre_only.plan(back, world.view()).cost, 0.7 * result.cost);
}

TEST(LongRobot, findsNoWayThroughACorridorThatIsTooNarrow) {
  PlannerParams params = longRobot();
  params.max_expansions = 20000;
  LatticePlanner planner(params);
  const World world = corridor(0.35);  // the robot is 0.4 m wide
  const PlanResult result = planner.plan(request({1.0, 1.2, 0.0}, {5.0, 1.2, 0.0}), world.view());
  EXPECT_NE(result.status, PlanStatus::kComplete);
  EXPECT_EQ(collisions(result.trajectory, world, parseFootprint(kLong).corners), 0);
}

TEST(LongRobot, seesALoneObstacleUnderItsMiddleAndItsEnds) {
  for (const double x : {0.0, 0.2, 0.4}) {
    World world = corridor(2.0);
    world.setStatic(*world.view().geometry.cellAt(3.0 + x, 1.2), sarn::kLethalObstacle);
    FootprintCheck check(parseFootprint(kLong), false);
    check.reset(world.view());
    EXPECT_FALSE(check.clearOfStatic({3.0, 1.2, 0.0})) << x;
    EXPECT_EQ(check.clearOfStatic({3.0, 1.2, 0.5 * sarn::kPi}), x > 0.3) << x;
  }
}

TEST(LongRobot, leavesAWallThatItTouchesAndGoesNoDeeper) {
  LatticePlanner planner(longRobot());
  World world = corridor(2.0);
  world.paintStatic(1.47, 1.2, 0.06, sarn::kLethalObstacle);  // under its nose
  const PlanRequest task = request({1.0, 1.2, 0.0}, {5.0, 1.2, 0.0});
  FootprintCheck check(parseFootprint(kLong), false);
  check.reset(world.view());
  int deepest = check.touchedStatic(task.start.pose());
  ASSERT_GT(deepest, 0);
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete) << toString(result.status);
  bool out = false;
  for (const auto& p : result.trajectory.points) {
    const int depth = check.touchedStatic(p.pose());
    EXPECT_LE(depth, deepest) << p.t;
    EXPECT_TRUE(!out || depth == 0) << "in again at " << p.t;
    deepest = depth;
    out = depth == 0;
  }
  EXPECT_TRUE(out);
}

// The forbidden disc around a person is for the centre of a round robot: of a long one, no point of its core
// may come into it, at the time.
TEST(LongRobot, keepsItsWholeLengthClearOfPeople) {
  const PlannerParams params = longRobot();
  LatticePlanner planner(params);
  World world = corridor(2.0);
  world.addLayers(20, 0.5);
  world.walk(3.0, 3.4, 0.0, -0.5, 0.45);
  const PlanRequest task = request({1.0, 1.2, 0.0}, {5.0, 1.2, 0.0});
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  for (double t = 0.0; t <= std::min(10.0, result.trajectory.endTime()); t += 0.05) {
    const sarn::Pose2D pose = result.trajectory.sample(t).pose();
    for (double along = -0.3; along <= 0.3; along += 0.05) {
      const Eigen::Vector2d p = pose * Eigen::Vector2d(along, 0.0);
      EXPECT_LE(world.costAt(p.x(), p.y(), t), 253) << t;
    }
  }
}

TEST(LongRobot, reversesOutOfACorridorWhenItMay) {
  PlannerParams params = longRobot();
  params.min_vel_x = -0.25;
  LatticePlanner planner(params);
  const World world = corridor(0.7);
  const PlanRequest task = request({3.2, 1.2, 0.0}, {2.4, 1.2, 0.0});
  const PlanResult result = planner.plan(task, world.view());
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  const PlanResult forwards = LatticePlanner(longRobot()).plan(task, world.view());  // has to turn in a room
  EXPECT_LT(result.cost, 0.6 * forwards.cost);
  EXPECT_EQ(collisions(result.trajectory, world, parseFootprint(kLong).corners), 0);
  double slowest = 0.0;
  double turned = 0.0;
  for (const auto& p : result.trajectory.points) {
    slowest = std::min(slowest, p.v);
    turned = std::max(turned, std::abs(sarn::wrapAngle(p.theta)));
  }
  EXPECT_LT(slowest, -0.2);
  EXPECT_LT(turned, 1.0) << "it need not turn to go back";
}

TEST(LongRobot, isTheSamePlannerAfterAMapOfAnotherResolution) {
  LatticePlanner planner(longRobot());
  const World narrow = corridor(0.7);
  const PlanRequest task = request({1.0, 0.9, 0.5 * sarn::kPi}, {5.0, 1.2, 0.0});
  const double cost = planner.plan(task, narrow.view()).cost;
  World coarse = World::room(4.0, 4.0, 0.1);
  EXPECT_EQ(planner.plan(request({1.0, 1.0, 0.0}, {3.0, 3.0, 0.0}), coarse.view()).status,
            PlanStatus::kComplete);
  EXPECT_DOUBLE_EQ(planner.plan(task, narrow.view()).cost, cost);
}

}  // namespace
}  // namespace lattice_planner::testing
