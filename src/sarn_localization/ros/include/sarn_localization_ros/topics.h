// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sarn_localization {

inline constexpr char kMapTopic[] = "map";                   // nav_msgs/OccupancyGrid, latched
inline constexpr char kMapMetadataTopic[] = "map_metadata";  // nav_msgs/MapMetaData, latched
inline constexpr char kStaticMapService[] = "static_map";    // nav_msgs/GetMap
inline constexpr char kTruthTopic[] = "ground_truth/odom";   // nav_msgs/Odometry, map -> base_footprint
inline constexpr char kLockstepTopic[] = "/lockstep/truth_localization";
inline constexpr char kOdometryTopic[] = "odom";  // nav_msgs/Odometry, odom -> base_footprint

}  // namespace sarn_localization
