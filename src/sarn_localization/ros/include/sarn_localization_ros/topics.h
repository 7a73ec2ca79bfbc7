// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sarn_localization {

inline constexpr char kMapTopic[] = "map";                     // nav_msgs/OccupancyGrid, latched
inline constexpr char kMapMetadataTopic[] = "map_metadata";    // nav_msgs/MapMetaData, latched
inline constexpr char kDynamicMapService[] = "dynamic_map";    // nav_msgs/GetMap
inline constexpr char kSlamLockstepTopic[] = "lockstep/slam";  // std_msgs/Time
inline constexpr char kStaticMapService[] = "static_map";      // nav_msgs/GetMap
inline constexpr char kTruthTopic[] = "ground_truth/odom";     // nav_msgs/Odometry, map -> base_footprint
inline constexpr char kLockstepTopic[] = "/lockstep/truth_localization";
inline constexpr char kScanTopic[] = "scan";                // sensor_msgs/LaserScan
inline constexpr char kInitialPoseTopic[] = "initialpose";  // geometry_msgs/PoseWithCovarianceStamped
inline constexpr char kPoseTopic[] = "amcl_pose";          // geometry_msgs/PoseWithCovarianceStamped, latched
inline constexpr char kParticleTopic[] = "particlecloud";  // geometry_msgs/PoseArray, latched
inline constexpr char kGlobalLocalizationService[] = "global_localization";    // std_srvs/Empty
inline constexpr char kLocalizationLockstepTopic[] = "lockstep/localization";  // std_msgs/Time
inline constexpr char kOdometryTopic[] = "odom";  // nav_msgs/Odometry, odom -> base_footprint

}  // namespace sarn_localization
