// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

namespace sarn_localization {

/// Offers one map: latched map and map_metadata, service static_map.
class MapServer {
 public:
  MapServer(ros::NodeHandle& nh, nav_msgs::OccupancyGrid map);

 private:
  bool serveMap(nav_msgs::GetMap::Request& request, nav_msgs::GetMap::Response& response);

  nav_msgs::OccupancyGrid map_;
  ros::Publisher map_publisher_;
  ros::Publisher metadata_publisher_;
  ros::ServiceServer service_;
};

}  // namespace sarn_localization
