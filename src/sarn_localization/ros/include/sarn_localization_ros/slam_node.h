// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/GetMap.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include "sarn_localization/grid_slam.h"
#include "sarn_localization_ros/scan_intake.h"

namespace sarn_localization {

/// gmapping's face on GridSlam: scan in; map, map_metadata and map -> odom out; service dynamic_map.
class SlamNode {
 public:
  SlamNode(ros::NodeHandle& nh, const SlamParams& params);

 private:
  void use(const ScanIntake::Input& input);
  void publishMap(const ros::Time& stamp);
  void broadcast(const ros::Time& stamp);
  bool serveMap(nav_msgs::GetMap::Request& request, nav_msgs::GetMap::Response& response);

  SlamParams params_;
  GridSlam slam_;
  ros::Time last_map_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher map_publisher_, metadata_publisher_;
  ros::ServiceServer map_service_;
  ScanIntake intake_;
};

}  // namespace sarn_localization
