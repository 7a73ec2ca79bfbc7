// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <kobuki_msgs/BumperEvent.h>
#include <kobuki_msgs/CliffEvent.h>
#include <kobuki_msgs/WheelDropEvent.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>

#include "sarn_navigation/clock_guard.h"
#include "sarn_navigation/safety_controller.h"

namespace sarn_navigation {

/// Wires SafetyController to the base's events and to the multiplexer.
class SafetyControllerNode {
 public:
  SafetyControllerNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void subscribe();
  void onBumper(const kobuki_msgs::BumperEvent& event);
  void onCliff(const kobuki_msgs::CliffEvent& event);
  void onWheelDrop(const kobuki_msgs::WheelDropEvent& event);
  void setEnabled(bool enabled);
  void reset(const char* reason);
  void publishCommand();

  ros::NodeHandle nh_;
  ros::NodeHandle private_nh_;
  SafetyControllerParams params_;
  SafetyController controller_;
  ClockGuard clock_;
  bool enabled_ = true;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher output_;
  ros::Timer timer_;
};

}  // namespace sarn_navigation
