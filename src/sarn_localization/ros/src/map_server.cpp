// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/map_server.h"

#include <utility>

#include "sarn_localization_ros/topics.h"

namespace sarn_localization {

MapServer::MapServer(ros::NodeHandle& nh, nav_msgs::OccupancyGrid map)
    : map_(std::move(map)),
      map_publisher_(nh.advertise<nav_msgs::OccupancyGrid>(kMapTopic, 1, true)),
      metadata_publisher_(nh.advertise<nav_msgs::MapMetaData>(kMapMetadataTopic, 1, true)),
      service_(nh.advertiseService(kStaticMapService, &MapServer::serveMap, this)) {
  map_publisher_.publish(map_);
  metadata_publisher_.publish(map_.info);
}

bool MapServer::serveMap(nav_msgs::GetMap::Request&, nav_msgs::GetMap::Response& response) {
  response.map = map_;
  return true;
}

}  // namespace sarn_localization
