// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "sarn_common/grid.h"

namespace sarn {

inline constexpr std::int8_t kMapFree = 0;
inline constexpr std::int8_t kMapOccupied = 100;
inline constexpr std::int8_t kMapUnknown = -1;

/// A map file that cannot be used; what() is one line that names the file, the key and what would be right.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Occupancy as in nav_msgs/OccupancyGrid: 0 free .. 100 occupied, -1 unknown.
using OccupancyMap = Grid<std::int8_t>;

/// Loads a ROS map: YAML (image, resolution, origin, negate, occupied_thresh, free_thresh, mode trinary)
/// beside a PGM (P2, P5) or PNG image, whose top row is the largest y. Throws MapError.
[[nodiscard]] OccupancyMap loadMap(const std::filesystem::path& yaml_file);

/// Writes base.yaml and base.pgm, or base and its YAML if base is *.png, for map_server. Throws MapError.
void saveMap(const OccupancyMap& map, const std::filesystem::path& base);

}  // namespace sarn
