// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "sarn_common/map_io.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization/wall_distance.h"

namespace sarn_localization {

/// A map drawn in rows from the top: '#' occupied, '.' free, '?' unknown; origin (0, 0).
inline sarn::OccupancyMap drawnMap(const std::vector<std::string>& rows, double resolution) {
  const auto height = static_cast<int>(rows.size());
  const auto width = static_cast<int>(rows.front().size());
  sarn::OccupancyMap map({width, height, resolution, 0.0, 0.0}, sarn::kMapUnknown);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      map.at({x, y}) = c == '#' ? sarn::kMapOccupied : c == '.' ? sarn::kMapFree : sarn::kMapUnknown;
    }
  }
  return map;
}

/// 8 m x 6 m, with a niche and a pillar so that no two places look alike; the same in cells of 0.1 m.
inline sarn::OccupancyMap unevenRoom() {
  constexpr double kCell = 0.05;
  sarn::OccupancyMap map({160, 120, kCell, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const bool outer = x < 2 || y < 2 || x > 157 || y > 117;
      const bool block = x >= 102 && y >= 82;
      const bool pillar = x >= 42 && x < 52 && y >= 32 && y < 38;
      const bool ledge = x < 30 && y >= 98;
      if (outer || block || pillar || ledge) map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return map;
}

/// 30 m x 30 m without anything in it.
inline sarn::OccupancyMap hall() {
  std::vector<std::string> rows(60, "#" + std::string(58, '.') + "#");
  rows.front() = rows.back() = std::string(60, '#');
  return drawnMap(rows, 0.5);
}

/// Two rooms of 6 m x 5 m, one 7 m to the right of the other, alike but for cupboards in the left one.
inline sarn::OccupancyMap twoRoomsAlike() {
  constexpr double kCell = 0.05;
  sarn::OccupancyMap map({264, 104, kCell, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 104; ++y) {
    for (int x = 0; x < 264; ++x) {
      const int in_room = x % 140;
      const bool outer = y < 2 || y > 101 || in_room < 2 || in_room > 121;
      const bool pillar = in_room >= 90 && in_room < 100 && y >= 70;
      const bool cupboard =
          x < 140 && ((y >= 92 && in_room >= 20 && in_room < 60) || (y < 12 && in_room >= 60));
      if (outer || pillar || cupboard) map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return map;
}

/// Every second cell of a map, twice as wide.
inline sarn::OccupancyMap coarser(const sarn::OccupancyMap& map) {
  const sarn::GridGeometry& fine = map.geometry;
  sarn::OccupancyMap half(
      {fine.width / 2, fine.height / 2, 2.0 * fine.resolution, fine.origin_x, fine.origin_y}, sarn::kMapFree);
  for (int y = 0; y < half.geometry.height; ++y) {
    for (int x = 0; x < half.geometry.width; ++x) half.at({x, y}) = map.at({2 * x, 2 * y});
  }
  return half;
}

/// What a sensor without noise at `map_from_sensor` measures: `count` beams over `width` [rad], ahead.
inline PlanarScan idealScan(const WallDistance& walls, const sarn::Pose2D& map_from_sensor, double width,
                            std::size_t count) {
  PlanarScan scan{-0.5 * width, width / static_cast<double>(count - 1), 0.1, 20.0, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        map_from_sensor.theta + scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    scan.ranges.push_back(static_cast<float>(
        walls.castRay(map_from_sensor.position(), {std::cos(angle), std::sin(angle)}, 20.0)));
  }
  return scan;
}

}  // namespace sarn_localization
