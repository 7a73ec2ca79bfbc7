// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// A map from rows of text, the top row at the largest y; '#' is a wall. Its lower left corner is the origin.
inline StaticMap drawnMap(const std::vector<std::string>& rows, double resolution) {
  const int height = static_cast<int>(rows.size());
  const int width = static_cast<int>(rows.front().size());
  sarn::OccupancyMap map({width, height, resolution, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      if (c == '#') map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return StaticMap(map);
}

}  // namespace kobuki_sim
