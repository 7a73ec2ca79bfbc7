// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_navigation/velocity_smoother.h"
#include "sarn_navigation_ros/line_throttle.h"

namespace sarn_navigation {

/// Wires VelocitySmoother to topics.
class VelocitySmootherNode {
 public:
  VelocitySmootherNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void subscribe();
  void onInput(const geometry_msgs::Twist& command);
  void onFeedback(const geometry_msgs::Twist& feedback, const ros::Subscriber& from);
  /// Logs one throttled line about a topic whose Twist is not finite.
  void complain(const ros::Subscriber& from);
  void onTimer();

  ros::NodeHandle private_nh_;
  VelocitySmootherParams params_;
  VelocitySmoother smoother_;
  sarn::LockstepAcknowledger lockstep_;
  ros::Subscriber input_;
  ros::Subscriber feedback_;
  ros::Publisher output_;
  ros::Timer timer_;
  LineThrottle nan_line_;
};

}  // namespace sarn_navigation
