// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <tf2_ros/buffer.h>

#include <string>
#include <vector>

namespace nav_core {

class BaseLocalPlanner {
 public:
  virtual ~BaseLocalPlanner() = default;
  virtual bool computeVelocityCommands(geometry_msgs::Twist& cmd_vel) = 0;
  virtual bool isGoalReached() = 0;
  virtual bool setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) = 0;
  virtual void initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) = 0;

 protected:
  BaseLocalPlanner() = default;
};

}  // namespace nav_core
