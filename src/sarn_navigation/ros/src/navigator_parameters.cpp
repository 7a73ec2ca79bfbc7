// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_parameters.h"

#include <ros/console.h>

#include <algorithm>
#include <sstream>

#include "lattice_planner/footprint.h"
#include "sarn_common_ros/parameter_reader.h"
#include "social_costmap_ros/parameters.h"

namespace sarn_navigation {

/// A polygon says by itself how near its centre may come to anything, as in costmap_2d.
void inflateByFootprint(NavigatorConfig& config) {
  const auto footprint = lattice_planner::parseFootprint(config.planner.footprint);
  if (footprint.round()) return;
  social_costmap::InflationLayerParams& inflation = config.costmap.inflation_layer;
  inflation.inscribed_radius = footprint.inscribed_radius;
  inflation.inflation_radius = std::max(inflation.inflation_radius, footprint.inscribed_radius);
  ROS_INFO("planner/footprint: the robot is no disc; costs are inflated by its inscribed radius, %.3f m",
           footprint.inscribed_radius);
}

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
  inflateByFootprint(config);
  if (config.follower.min_vel_x > config.planner.min_vel_x) {
    std::ostringstream text;
    text << private_nh.getNamespace() << ": planner/min_vel_x: " << config.planner.min_vel_x
         << " plans backwards, what the follower must not drive; follower/min_vel_x: "
         << config.follower.min_vel_x << " must not be larger";
    throw sarn::ParameterError(text.str());
  }
  return config;
}

}  // namespace sarn_navigation
