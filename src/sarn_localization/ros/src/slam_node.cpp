// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/slam_node.h"

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>

#include <cmath>

#include "sarn_common_ros/conversions.h"
#include "sarn_localization_ros/topics.h"

namespace sarn_localization {

SlamNode::SlamNode(ros::NodeHandle& nh, const SlamParams& params)
    : params_(params),
      slam_(params),
      map_publisher_(nh.advertise<nav_msgs::OccupancyGrid>(kMapTopic, 1, true)),
      metadata_publisher_(nh.advertise<nav_msgs::MapMetaData>(kMapMetadataTopic, 1, true)),
      map_service_(nh.advertiseService(kDynamicMapService, &SlamNode::serveMap, this)),
      intake_(nh, params_.odom_frame, params_.base_frame, kSlamLockstepTopic,
              [this](const ScanIntake::Input& input) { use(input); }) {}

void SlamNode::use(const ScanIntake::Input& input) {
  const bool used = slam_.addScan(input.robot_in_odom, input.base_from_sensor, input.scan);
  const double since_map = std::abs((input.stamp - last_map_).toSec());
  if (used && (last_map_.isZero() || since_map >= params_.map_update_interval)) publishMap(input.stamp);
  broadcast(input.stamp);
}

void SlamNode::publishMap(const ros::Time& stamp) {
  const auto map = slam_.map();
  if (!map) return;
  nav_msgs::OccupancyGrid message = sarn::toMessage(*map, params_.map_frame);
  message.header.stamp = message.info.map_load_time = stamp;
  map_publisher_.publish(message);
  metadata_publisher_.publish(message.info);
  last_map_ = stamp;
}

bool SlamNode::serveMap(nav_msgs::GetMap::Request& /*request*/, nav_msgs::GetMap::Response& response) {
  const auto map = slam_.map();
  if (!map) return false;
  response.map = sarn::toMessage(*map, params_.map_frame);
  response.map.header.stamp = ros::Time::now();
  return true;
}

void SlamNode::broadcast(const ros::Time& stamp) {
  const auto map_from_odom = slam_.mapFromOdom();
  if (!map_from_odom) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp + ros::Duration(params_.tf_delay);
  transform.header.frame_id = params_.map_frame;
  transform.child_frame_id = params_.odom_frame;
  transform.transform = sarn::toTransformMessage(*map_from_odom);
  broadcaster_.sendTransform(transform);
}

}  // namespace sarn_localization
