// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "sarn_navigation/live_planner.h"

namespace sarn_navigation {

/// The service make_plan, answered in a thread of its own with a planner of its own, so that driving goes on.
class PlanService {
 public:
  using SceneSource =
      std::function<std::shared_ptr<const sarn::TimedCostmapView>()>;  // any thread; null: no costs yet

  PlanService(const ros::NodeHandle& private_nh, const lattice_planner::PlannerParams& params,
              std::string global_frame, SceneSource scene);

  /// The next answer follows these; throws std::invalid_argument.
  void setParams(const lattice_planner::PlannerParams& params) { planner_.setParams(params); }

 private:
  bool onMakePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);

  std::string global_frame_;
  SceneSource scene_;
  LivePlanner planner_;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;  // last member: stops first
};

}  // namespace sarn_navigation
