// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/plan_service.h"

#include <utility>

#include "sarn_common_ros/conversions.h"
#include "sarn_navigation_ros/navigator_topics.h"
#include "sarn_navigation_ros/path_conversions.h"

namespace sarn_navigation {
namespace {

constexpr double kTimeLimit = 1.0;  // [s] wall time of one answer

}  // namespace

PlanService::PlanService(const ros::NodeHandle& private_nh, const lattice_planner::PlannerParams& params,
                         std::string global_frame, SceneSource scene)
    : global_frame_(std::move(global_frame)),
      scene_(std::move(scene)),
      planner_(params),
      nh_(private_nh),
      spinner_(1, &queue_) {
  nh_.setCallbackQueue(&queue_);
  server_ = nh_.advertiseService(topics::kMakePlan, &PlanService::onMakePlan, this);
  spinner_.start();
}

bool PlanService::onMakePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response) {
  response.plan.header.frame_id = global_frame_;
  response.plan.header.stamp = ros::Time::now();
  const auto scene = scene_();
  const auto start = sarn::fromMessage(request.start.pose);
  const auto goal = sarn::fromMessage(request.goal.pose);
  std::string problem;
  if (!scene) {
    problem = "there is no map yet";
  } else if (!start || !goal) {
    problem = "start and goal must be finite poses with a rotation about z";
  } else if (request.start.header.frame_id != global_frame_ ||
             request.goal.header.frame_id != global_frame_) {
    problem = "start and goal must be in frame " + global_frame_;
  }
  if (!problem.empty()) {
    ROS_ERROR("make_plan: %s", problem.c_str());
    return false;
  }
  planner_.waitUntilReady();
  const double now = response.plan.header.stamp.toSec();
  const auto result =
      planner_.plan({{start->x, start->y, start->theta, 0.0, 0.0, now}, *goal, kTimeLimit}, *scene);
  if (!lattice_planner::isDrivable(result.status)) {
    ROS_WARN("make_plan: %s", lattice_planner::toString(result.status));
    return true;  // an empty plan, as move_base answers
  }
  response.plan = toPath(result.trajectory, global_frame_);
  return true;
}

}  // namespace sarn_navigation
