// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/Twist.h>
#include <ros/ros.h>
#include <sarn_navigation/CmdVelMuxConfig.h>

#include <memory>
#include <string>
#include <vector>

#include "sarn_navigation/velocity_mux.h"
#include "sarn_navigation_ros/line_throttle.h"

namespace sarn_navigation {

/// Wires VelocityMux to topics; the list of inputs can be replaced through dynamic_reconfigure.
class CmdVelMuxNode {
 public:
  CmdVelMuxNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void apply(const MuxConfig& config);
  void reconfigure(CmdVelMuxConfig& config);
  void onCommand(std::size_t input, const geometry_msgs::TwistConstPtr& command);
  void publishActive();

  ros::NodeHandle private_nh_;
  std::unique_ptr<VelocityMux> mux_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<LineThrottle> nan_lines_;  // one an input
  ros::Publisher output_;
  ros::Publisher active_;
  std::string published_active_;
  ros::Timer expiry_timer_;
  CmdVelMuxConfig effective_;
  bool started_ = false;
  std::unique_ptr<dynamic_reconfigure::Server<CmdVelMuxConfig>> server_;
};

}  // namespace sarn_navigation
