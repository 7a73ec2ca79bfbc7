// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap_ros/conversions.h"

#include <ros/time.h>

#include <algorithm>

#include "sarn_common/cost_values.h"

namespace social_costmap_ros {

social_costmap::Scan fromMessage(const sensor_msgs::LaserScan& message, const sarn::Pose2D& sensor_in_map) {
  social_costmap::Scan scan;
  scan.sensor_in_map = sensor_in_map;
  scan.angle_min = static_cast<double>(message.angle_min);
  scan.angle_increment = static_cast<double>(message.angle_increment);
  scan.range_min = static_cast<double>(message.range_min);
  scan.range_max = static_cast<double>(message.range_max);
  scan.stamp = message.header.stamp.toSec();
  scan.ranges = message.ranges;
  return scan;
}

std::int8_t occupancyOfCost(std::uint8_t cost) {
  if (cost == sarn::kNoInformation) return -1;
  if (cost == sarn::kLethalObstacle) return 100;
  if (cost == sarn::kInscribedObstacle) return 99;
  if (cost == sarn::kFreeSpace) return 0;
  return static_cast<std::int8_t>(1 + (97 * (cost - 1)) / 251);
}

nav_msgs::OccupancyGrid toMessage(const sarn::GridGeometry& geometry, const std::uint8_t* cells,
                                  const std::string& frame, double stamp) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time(stamp);
  message.info.map_load_time = message.header.stamp;
  message.info.resolution = static_cast<float>(geometry.resolution);
  message.info.width = static_cast<std::uint32_t>(geometry.width);
  message.info.height = static_cast<std::uint32_t>(geometry.height);
  message.info.origin.position.x = geometry.origin_x;
  message.info.origin.position.y = geometry.origin_y;
  message.info.origin.orientation.w = 1.0;
  message.data.resize(geometry.size());
  std::transform(cells, cells + geometry.size(), message.data.begin(), occupancyOfCost);
  return message;
}

}  // namespace social_costmap_ros
