// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <message_filters/subscriber.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <cstddef>
#include <optional>
#include <string>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_localization/monte_carlo_localizer.h"
#include "sarn_localization_ros/scan_order.h"

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
  void onScan(const sensor_msgs::LaserScanConstPtr& scan);
  void onScanWithoutTransform(const sensor_msgs::LaserScanConstPtr& scan,
                              tf2_ros::filter_failure_reasons::FilterFailureReason reason);

  /// Whether the scan can be used; one throttled line when not.
  [[nodiscard]] bool usable(const sensor_msgs::LaserScan& scan);
  void use(const sensor_msgs::LaserScan& scan);
  /// Planar pose of `child` in `parent`; nothing, with a throttled line, when tf does not know.
  [[nodiscard]] std::optional<sarn::Pose2D> lookUp(const std::string& parent, const std::string& child,
                                                   const ros::Time& stamp);
  void publishPose(const ros::Time& stamp);
  void broadcast(const ros::Time& stamp);

  LocalizationParams params_;
  MonteCarloLocalizer localizer_;
  ScanOrderGuard order_;
  std::size_t beam_count_ = 0;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_publisher_, particle_publisher_;
  ros::ServiceServer global_localization_;
  sarn::LockstepAcknowledger lockstep_;
  ros::Subscriber map_subscriber_, initial_pose_subscriber_;
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scans_;
};

}  // namespace sarn_localization
