// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_common/map_io.h"
#include "sarn_common/pose2d.h"
#include "sarn_perception/depth_to_scan.h"
#include "sarn_perception/visibility.h"

namespace sarn_perception {

/// A 6 m x 6 m room from (0, 0) with walls of 0.2 m, free inside; walls lie within its outermost cells.
inline sarn::OccupancyMap room() {
  sarn::OccupancyMap map({120, 120, 0.05, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) {
      if (x < 4 || y < 4 || x > 115 || y > 115) map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return map;
}

/// Distance [m] from a point in the room to its walls along a direction.
inline double toRoomWall(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
  double distance = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    if (direction[axis] > 1e-12) distance = std::min(distance, (5.8 - from[axis]) / direction[axis]);
    if (direction[axis] < -1e-12) distance = std::min(distance, (0.2 - from[axis]) / direction[axis]);
  }
  return distance;
}

/// Distance [m] to a disc along a direction; infinite when it is missed.
inline double toDisc(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, const Disc& disc) {
  const Eigen::Vector2d way = disc.center - from;
  const double along = way.dot(direction);
  const double beside = way.squaredNorm() - along * along;
  const double inside = disc.radius * disc.radius - beside;
  if (inside < 0.0 || along < 0.0) return std::numeric_limits<double>::infinity();
  return along - std::sqrt(inside);
}

/// The exact scan of a room with discs in it.
inline PlanarScan scanOf(const sarn::Pose2D& sensor, const std::vector<Disc>& discs, int beams = 720,
                         double field_of_view = 2.0 * sarn::kPi) {
  PlanarScan scan;
  const double increment = field_of_view / beams;
  scan.angle_min = static_cast<float>(-0.5 * field_of_view);
  scan.angle_increment = static_cast<float>(increment);
  scan.angle_max = static_cast<float>(-0.5 * field_of_view + increment * (beams - 1));
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  for (int i = 0; i < beams; ++i) {
    const double bearing = sensor.theta - 0.5 * field_of_view + increment * i;
    const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
    double range = toRoomWall(sensor.position(), direction);
    for (const Disc& disc : discs) range = std::min(range, toDisc(sensor.position(), direction, disc));
    scan.ranges.push_back(static_cast<float>(range));
  }
  return scan;
}

/// The scan of what a map shows as occupied, exact to 5 mm.
inline PlanarScan scanOf(const sarn::Pose2D& sensor, const sarn::OccupancyMap& map, int beams,
                         double field_of_view) {
  PlanarScan scan = scanOf(sensor, std::vector<Disc>{}, beams, field_of_view);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double bearing =
        sensor.theta - 0.5 * field_of_view + field_of_view / beams * static_cast<double>(i);
    const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
    double range = 0.0;
    for (;; range += 0.005) {
      const Eigen::Vector2d place = sensor.position() + range * direction;
      const auto cell = map.geometry.cellAt(place.x(), place.y());
      if (!cell || map.at(*cell) == sarn::kMapOccupied) break;
    }
    scan.ranges[i] = static_cast<float>(range);
  }
  return scan;
}

/// Marks a box of a map as occupied; corners [m].
inline void addBox(const Eigen::Vector2d& least, const Eigen::Vector2d& most, sarn::OccupancyMap& map) {
  for (int y = 0; y < map.geometry.height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      const Eigen::Vector2d center(map.geometry.origin_x + (x + 0.5) * map.geometry.resolution,
                                   map.geometry.origin_y + (y + 0.5) * map.geometry.resolution);
      if ((center.array() > least.array()).all() && (center.array() < most.array()).all()) {
        map.at({x, y}) = sarn::kMapOccupied;
      }
    }
  }
}

/// The legs of somebody who stands there and looks along `heading` [rad].
inline std::vector<Disc> legsAt(const Eigen::Vector2d& place, double heading = 0.0) {
  const Eigen::Vector2d side(-0.09 * std::sin(heading), 0.09 * std::cos(heading));
  return {{place + side, 0.056}, {place - side, 0.056}};
}

}  // namespace sarn_perception
