// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <optional>
#include <string>

#include "sarn_navigation/clock_guard.h"
#include "sarn_navigation/scan_brake.h"
#include "sarn_navigation_ros/line_throttle.h"
#include "sarn_navigation_ros/parameters.h"

namespace sarn_navigation {

/// Wires ScanBrake between the navigator's commands and the velocity smoother.
class ScanBrakeNode {
 public:
  ScanBrakeNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void onCommand(const geometry_msgs::Twist& command);
  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onTimer();
  /// Forgets everything when the clock has jumped back.
  void guardClock(double now);
  /// Feeds the scans whose transform has arrived.
  void digestScans(double now);
  [[nodiscard]] bool digest(const sensor_msgs::LaserScan& message);
  struct StampedPose {
    sarn::Pose2D pose;   // in odom
    double stamp = 0.0;  // [s]
  };
  /// Pose of a frame in odom; on failure nothing, and one sentence in `problem`, which a success empties.
  [[nodiscard]] std::optional<StampedPose> lookUp(const std::string& frame, const ros::Time& stamp,
                                                  std::string& problem) const;
  [[nodiscard]] std::optional<sarn::Pose2D> basePose(double now);
  [[nodiscard]] BrakeDecision decide(double now);
  void send(const BrakeDecision& decision, double now);
  void report(const BrakeDecision& decision);
  void publishBraking(bool braking);

  ros::NodeHandle nh_;
  ros::NodeHandle private_nh_;
  ScanBrakeNodeParams params_;
  ScanBrake brake_;
  ClockGuard clock_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  ros::Subscriber command_subscriber_;
  ros::Subscriber scan_subscriber_;
  ros::Publisher output_;
  ros::Publisher braking_;
  ros::Timer timer_;
  std::deque<sensor_msgs::LaserScanConstPtr> pending_scans_;  // their transform has not arrived yet
  std::optional<sarn::Twist2D> wanted_;                       // last command
  double wanted_time_ = 0.0;                                  // [s]
  sarn::Twist2D sent_;
  double sent_time_ = 0.0;  // [s]
  std::optional<bool> published_braking_;
  std::string scan_tf_problem_;  // why the last scan could not be placed; empty when it could
  std::string base_tf_problem_;  // the same for the robot
  LineThrottle stop_line_;
  LineThrottle nan_line_;
  LineThrottle scan_line_;
};

}  // namespace sarn_navigation
