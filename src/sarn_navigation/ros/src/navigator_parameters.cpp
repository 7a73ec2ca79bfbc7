// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_parameters.h"

#include "sarn_common_ros/parameter_reader.h"
#include "social_costmap_ros/parameters.h"

namespace sarn_navigation {

NavigatorConfig readNavigatorConfig(const ros::NodeHandle& private_nh) {
  NavigatorConfig config;
  config.node =
      sarn::readParameters<NavigatorNodeParams>(private_nh, {"navigator", "planner", "follower", "costmap"});
  config.navigator = sarn::readParameters<NavigatorParams>(ros::NodeHandle(private_nh, "navigator"));
  config.planner =
      sarn::readParameters<lattice_planner::PlannerParams>(ros::NodeHandle(private_nh, "planner"));
  config.follower =
      sarn::readParameters<timed_path_follower::FollowerParams>(ros::NodeHandle(private_nh, "follower"));
  config.costmap = social_costmap_ros::readCostmapParams(ros::NodeHandle(private_nh, "costmap"));
  return config;
}

}  // namespace sarn_navigation
