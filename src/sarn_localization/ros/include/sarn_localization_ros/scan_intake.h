// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <message_filters/subscriber.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "sarn_common/pose2d.h"
#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization_ros/scan_order.h"

namespace sarn_localization {

/// Scans with the odometry of their time: a scan waits until that has come. What cannot be used is left out,
/// with one throttled line that says why.
class ScanIntake {
 public:
  struct Input {
    ros::Time stamp;
    PlanarScan scan;
    sarn::Pose2D base_from_sensor;
    sarn::Pose2D robot_in_odom;
  };
  using Use = std::function<void(const Input&)>;

  ScanIntake(ros::NodeHandle& nh, std::string odom_frame, std::string base_frame,
             const std::string& lockstep_topic, Use use);

  /// The robot's pose in odom at a time, or now when that is not known.
  [[nodiscard]] std::optional<sarn::Pose2D> robotInOdom(const ros::Time& stamp);

 private:
  void onScan(const sensor_msgs::LaserScanConstPtr& scan);
  void onScanWithoutTransform(const sensor_msgs::LaserScanConstPtr& scan);
  [[nodiscard]] bool usable(const sensor_msgs::LaserScan& scan);
  /// Planar pose of `child` in `parent`.
  [[nodiscard]] std::optional<sarn::Pose2D> lookUp(const std::string& parent, const std::string& child,
                                                   const ros::Time& stamp);

  std::string odom_frame_, base_frame_;
  Use use_;
  ScanOrderGuard order_;
  std::size_t beam_count_ = 0;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  sarn::LockstepAcknowledger lockstep_;
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scans_;
};

}  // namespace sarn_localization
