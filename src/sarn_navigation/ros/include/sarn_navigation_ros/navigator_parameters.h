// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "lattice_planner/planner_params.h"
#include "sarn_navigation/navigator_params.h"
#include "social_costmap/timed_costmap.h"
#include "timed_path_follower/follower_params.h"

namespace sarn_navigation {

struct NavigatorNodeParams {
  std::string global_frame = "map";
  std::string robot_base_frame = "base_footprint";
  std::string social =
      "timed";  // timed: people move; frozen: people stand where they are now; off: they are obstacles
  std::string search = "lattice";        // lattice, or a baseline of OMPL: ompl_sst, ompl_rrt, ompl_kpiece
  double costmap_frequency = 10.0;       // [Hz]
  double visualization_frequency = 2.0;  // [Hz] simulated time; only while somebody listens
  double pose_patience = 10.0;           // [s] a goal waits this long for the robot's pose and the map
  bool lockstep = false;                 // the simulation waits for plans that are due

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("global_frame", p.global_frame);
    v("robot_base_frame", p.robot_base_frame);
    v("social", p.social);
    v("search", p.search);
    v("costmap_frequency", p.costmap_frequency, {0.5, 50.0});
    v("visualization_frequency", p.visualization_frequency, {0.1, 20.0});
    v("pose_patience", p.pose_patience, {0.0, 600.0});
    v("lockstep", p.lockstep);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    std::vector<std::string> all;
    if (social != "timed" && social != "frozen" && social != "off")
      all.emplace_back("social: must be timed, frozen or off");
    if (search != "lattice" && search != "ompl_sst" && search != "ompl_rrt" && search != "ompl_kpiece")
      all.emplace_back("search: must be lattice, ompl_sst, ompl_rrt or ompl_kpiece");
    return all;
  }
};

/// Everything the node is told, one sub-namespace each: navigator, planner, follower, costmap/{...}.
struct NavigatorConfig {
  NavigatorNodeParams node;
  NavigatorParams navigator;
  lattice_planner::PlannerParams planner;
  timed_path_follower::FollowerParams follower;
  social_costmap::CostmapParams costmap;
};

/// With planner/footprint the costmap's inflation follows from it, whatever inscribed_radius says.
void inflateByFootprint(NavigatorConfig& config);

/// Throws sarn::ParameterError.
[[nodiscard]] NavigatorConfig readNavigatorConfig(const ros::NodeHandle& private_nh);

}  // namespace sarn_navigation
