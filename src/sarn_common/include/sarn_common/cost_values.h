// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sarn {

// Cell costs as costmap_2d defines them.
inline constexpr std::uint8_t kFreeSpace = 0;
inline constexpr std::uint8_t kInscribedObstacle = 253;  // the robot's centre here means contact
inline constexpr std::uint8_t kLethalObstacle = 254;
inline constexpr std::uint8_t kNoInformation = 255;

}  // namespace sarn
