// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace sarn_navigation {

NavigatorConfig readNavigatorConfig(const ros::NodeHandle& private_nh) {
  NavigatorConfig config;
  config.node = sarn::readParameters<NavigatorNodeParams>(private_nh, {"navigator", "planner", "follower", "costmap"});
  config.navigator = sarn::readParameters<NavigatorParams>(ros::NodeHandle(private_nh, "navigator"));
  config.planner = sarn::readParameters<lattice_planner::PlannerParams>(ros::NodeHandle(private_nh, "planner"));
  config.follower = sarn::readParameters<timed_path_follower::FollowerParams>(ros::NodeHandle(private_nh, "follower"));
  const ros::NodeHandle costmap(private_nh, "costmap");
  using namespace social_costmap;
  config.costmap.static_layer = sarn::readParameters<StaticLayerParams>(ros::NodeHandle(costmap, "static"));
  config.costmap.obstacle_layer = sarn::readParameters<ObstacleLayerParams>(ros::NodeHandle(costmap, "obstacle"));
  config.costmap.inflation_layer = sarn::readParameters<InflationLayerParams>(ros::NodeHandle(costmap, "inflation"));
  config.costmap.social_layers = sarn::readParameters<SocialParams>(ros::NodeHandle(costmap, "social"));
  return config;
}

}  // namespace sarn_navigation
