// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_broadcaster.h>

#include "sarn_localization/monte_carlo_localizer.h"
#include "sarn_localization_ros/scan_intake.h"

namespace sarn_localization {

/// amcl's face on MonteCarloLocalizer: map, scan and initialpose in; map -> odom, amcl_pose and particlecloud
/// out; service global_localization. A scan waits until the odometry of its time has come.
class LocalizationNode {
 public:
  LocalizationNode(ros::NodeHandle& nh, const LocalizationParams& params);

 private:
  void onMap(const nav_msgs::OccupancyGrid& message);
  void onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message);
  bool onGlobalLocalization(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  void use(const ScanIntake::Input& input);
  void publishPose(const ros::Time& stamp);
  void broadcast(const ros::Time& stamp);

  LocalizationParams params_;
  MonteCarloLocalizer localizer_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_publisher_, particle_publisher_;
  ros::ServiceServer global_localization_;
  ros::Subscriber map_subscriber_, initial_pose_subscriber_;
  ScanIntake intake_;
};

}  // namespace sarn_localization
