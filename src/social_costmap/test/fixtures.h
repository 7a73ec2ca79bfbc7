// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sarn_common/map_io.h"
#include "sarn_common/people.h"
#include "social_costmap/layer.h"

namespace social_costmap::testing {

/// A world drawn by hand: '#' occupied, '?' unknown, anything else free; the first row is the largest y.
inline sarn::OccupancyMap drawMap(const std::vector<std::string>& rows, double resolution = 0.1) {
  const sarn::GridGeometry geometry{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()),
                                    resolution, 0.0, 0.0};
  sarn::OccupancyMap map(geometry, sarn::kMapFree);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const char c = rows[static_cast<std::size_t>(geometry.height - 1 - y)][static_cast<std::size_t>(x)];
      if (c == '#') map.at({x, y}) = sarn::kMapOccupied;
      if (c == '?') map.at({x, y}) = sarn::kMapUnknown;
    }
  }
  return map;
}

inline sarn::OccupancyMap emptyMap(int width, int height, double resolution = 0.05) {
  return {sarn::GridGeometry{width, height, resolution, 0.0, 0.0}, sarn::kMapFree};
}

/// Somebody who walks straight, from `position` at the prediction's stamp.
inline sarn::PersonPrediction walker(const std::string& name, const Eigen::Vector2d& position,
                                     const Eigen::Vector2d& velocity, int steps = 20, double sigma = 0.0,
                                     const std::string& group = "") {
  sarn::PersonPrediction person;
  person.name = name;
  person.group = group;
  for (int i = 0; i < steps; ++i) person.states.push_back({position + 0.5 * i * velocity, velocity, sigma});
  return person;
}

inline sarn::PeoplePrediction prediction(std::vector<sarn::PersonPrediction> people, double stamp = 10.0) {
  return {stamp, 0.5, std::move(people)};
}

inline double nan() { return std::numeric_limits<double>::quiet_NaN(); }

/// Cells that differ from zero.
inline int paintedCells(const std::vector<std::uint8_t>& cells) {
  int count = 0;
  for (const std::uint8_t cost : cells) count += cost != 0 ? 1 : 0;
  return count;
}

}  // namespace social_costmap::testing
