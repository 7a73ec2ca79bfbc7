// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>

#include <string>
#include <vector>

namespace nav_core {

class BaseGlobalPlanner {
 public:
  virtual ~BaseGlobalPlanner() = default;
  virtual bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                        std::vector<geometry_msgs::PoseStamped>& plan) = 0;
  virtual bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                        std::vector<geometry_msgs::PoseStamped>& plan, double& cost) {
    cost = 0.0;
    return makePlan(start, goal, plan);
  }
  virtual void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) = 0;

 protected:
  BaseGlobalPlanner() = default;
};

}  // namespace nav_core
