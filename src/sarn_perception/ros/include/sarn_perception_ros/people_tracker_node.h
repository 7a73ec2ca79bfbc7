// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_perception/people_perception.h"
#include "sarn_perception/people_tracker_params.h"

namespace sarn_perception {

/// scan, and depth image where there is one, with map and tf -> people. People go on by prediction when the
/// sensors fall silent or the robot is lost, and expire; without a map or localisation no scan is used, as
/// walls cannot be told from people then.
class PeopleTrackerNode {
 public:
  /// Throws sarn::ParameterError.
  PeopleTrackerNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void takeMap(const nav_msgs::OccupancyGridConstPtr& map);
  void takeScan(const sensor_msgs::LaserScanConstPtr& scan);
  void takeImage(const sensor_msgs::ImageConstPtr& image);
  void track(const sensor_msgs::LaserScanConstPtr& scan);
  void lookForBodies(const sensor_msgs::ImageConstPtr& image);
  /// Whether a stamp can be believed; one line says why not.
  [[nodiscard]] bool usable(const std_msgs::Header& header, const std::string& topic) const;
  [[nodiscard]] bool ready(const std::string& topic) const;
  /// A line about a scan that is used, but is not as the others before or shows nothing.
  void remark(const sensor_msgs::LaserScan& scan);
  void watchClock();
  [[nodiscard]] std::optional<sarn::Pose2D> planar(const std::string& target, const std::string& source,
                                                   const ros::Time& stamp) const;
  [[nodiscard]] std::optional<sarn::Pose2D> localization(const ros::Time& stamp) const;
  void predictAlone();
  void publish(const ros::Time& stamp, const sarn::Pose2D& map_from_odom);

  ros::NodeHandle nh_;
  PeopleTrackerParams params_;
  PeoplePerception perception_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scans_;  // that wait for their transform
  tf2_ros::MessageFilter<sensor_msgs::Image> images_;
  sensor_msgs::CameraInfoConstPtr camera_info_;
  std::optional<std::size_t> beam_count_;  // of the last scan
  std::optional<std::string> scan_frame_;
  std::optional<double> map_resolution_;  // [m]
  ros::Time last_now_, last_scan_, last_image_, next_publication_, next_body_;
  ros::Publisher people_publisher_, tracked_publisher_, marker_publisher_;
  sarn::LockstepAcknowledger lockstep_;
  ros::Subscriber map_subscriber_, scan_subscriber_, image_subscriber_, info_subscriber_;
  ros::Timer timer_;
};

}  // namespace sarn_perception
