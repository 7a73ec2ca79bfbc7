// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace social_costmap_ros {

// Below the namespace that the node gives the publisher (move_base/costmap).
inline constexpr char kStaticCostsTopic[] = "costmap";  // nav_msgs/OccupancyGrid: walls, obstacles, inflation
inline constexpr char kSocialCostsTopic[] = "social_layer";      // nav_msgs/OccupancyGrid: one time layer
inline constexpr char kPeopleMarkersTopic[] = "people_markers";  // visualization_msgs/MarkerArray

}  // namespace social_costmap_ros
