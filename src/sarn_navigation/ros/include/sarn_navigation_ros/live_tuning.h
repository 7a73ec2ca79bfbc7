// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <lattice_planner/PlannerConfig.h>
#include <ros/ros.h>
#include <social_costmap/SocialConfig.h>

#include <boost/thread/recursive_mutex.hpp>
#include <functional>

#include "lattice_planner/planner_params.h"
#include "social_costmap/social_params.h"

namespace sarn_navigation {

/// What a person may change while the robot drives, by rqt_reconfigure: people's costs (~costmap/social) and
/// the planner's weights (~planner). Values outside their range are set to the nearest inside by
/// dynamic_reconfigure, what is not a number is refused; each effective change is one log line.
class LiveTuning {
 public:
  struct Handlers {
    std::function<void(const social_costmap::SocialParams&)> social;
    std::function<void(const lattice_planner::PlannerParams&)> planner;
  };

  LiveTuning(const ros::NodeHandle& private_nh, const social_costmap::SocialParams& social,
             const lattice_planner::PlannerParams& planner, Handlers handlers);

 private:
  void onSocial(social_costmap::SocialConfig& config);
  void onPlanner(lattice_planner::PlannerConfig& config);

  social_costmap::SocialParams social_;
  lattice_planner::PlannerParams planner_;
  Handlers handlers_;
  boost::recursive_mutex social_mutex_;
  boost::recursive_mutex planner_mutex_;
  dynamic_reconfigure::Server<social_costmap::SocialConfig> social_server_;
  dynamic_reconfigure::Server<lattice_planner::PlannerConfig> planner_server_;
};

}  // namespace sarn_navigation
