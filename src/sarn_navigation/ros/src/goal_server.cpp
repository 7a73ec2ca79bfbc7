// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/goal_server.h"

#include <tf2/exceptions.h>

#include <utility>

#include "sarn_common_ros/conversions.h"
#include "sarn_navigation_ros/navigator_topics.h"

namespace sarn_navigation {

GoalServer::GoalServer(ros::NodeHandle nh, tf2_ros::Buffer& buffer, std::string global_frame,
                       Handlers handlers)
    : nh_(std::move(nh)),
      buffer_(buffer),
      global_frame_(std::move(global_frame)),
      handlers_(std::move(handlers)),
      server_(nh_, topics::kAction, false) {
  action_goal_ = nh_.advertise<move_base_msgs::MoveBaseActionGoal>(std::string(topics::kAction) + "/goal", 1);
  current_goal_ = ros::NodeHandle("~").advertise<geometry_msgs::PoseStamped>(topics::kCurrentGoal, 1, true);
  simple_goal_ = nh_.subscribe(topics::kSimpleGoal, 1, &GoalServer::onSimpleGoal, this);
  server_.registerGoalCallback([this] { onGoal(); });
  server_.registerPreemptCallback([this] { onPreempt(); });
  server_.start();
}

void GoalServer::onSimpleGoal(const geometry_msgs::PoseStamped& goal) {
  move_base_msgs::MoveBaseActionGoal action_goal;
  action_goal.header.stamp = ros::Time::now();
  action_goal.goal.target_pose = goal;
  action_goal_.publish(action_goal);
}

std::string GoalServer::toGlobalFrame(const geometry_msgs::PoseStamped& goal,
                                      sarn::Pose2D& goal_in_map) const {
  const auto pose = sarn::fromMessage(goal.pose);
  if (!pose) return "goal is not a finite pose with a rotation about z";
  if (goal.header.frame_id.empty()) return "goal has no frame_id";
  if (goal.header.frame_id == global_frame_) {
    goal_in_map = *pose;
    return {};
  }
  try {
    const auto transform = sarn::fromMessage(
        buffer_.lookupTransform(global_frame_, goal.header.frame_id, ros::Time(0)).transform);
    if (!transform) return "frame " + goal.header.frame_id + " is tilted against " + global_frame_;
    goal_in_map = *transform * *pose;
    return {};
  } catch (const tf2::TransformException& error) {
    return std::string("goal's frame: ") + error.what();
  }
}

void GoalServer::onGoal() {
  const auto goal = server_.acceptNewGoal();
  sarn::Pose2D goal_in_map;
  std::string problem = toGlobalFrame(goal->target_pose, goal_in_map);
  if (problem.empty()) problem = handlers_.accept(goal_in_map);
  if (!problem.empty()) {
    abort(problem);
    handlers_.cancel();
    return;
  }
  geometry_msgs::PoseStamped current;
  current.header.frame_id = global_frame_;
  current.header.stamp = ros::Time::now();
  current.pose = sarn::toMessage(goal_in_map);
  current_goal_.publish(current);
}

void GoalServer::onPreempt() {
  if (server_.isNewGoalAvailable()) return;  // onGoal follows
  handlers_.cancel();
  if (server_.isActive()) server_.setPreempted(move_base_msgs::MoveBaseResult(), "cancelled");
}

void GoalServer::publishFeedback(const sarn::Pose2D& robot, const ros::Time& stamp) {
  if (!server_.isActive()) return;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.frame_id = global_frame_;
  feedback.base_position.header.stamp = stamp;
  feedback.base_position.pose = sarn::toMessage(robot);
  server_.publishFeedback(feedback);
}

void GoalServer::succeed() {
  if (server_.isActive()) server_.setSucceeded(move_base_msgs::MoveBaseResult(), "goal reached");
}

void GoalServer::abort(const std::string& reason) {
  ROS_WARN("goal given up: %s", reason.c_str());
  if (server_.isActive()) server_.setAborted(move_base_msgs::MoveBaseResult(), reason);
}

}  // namespace sarn_navigation
