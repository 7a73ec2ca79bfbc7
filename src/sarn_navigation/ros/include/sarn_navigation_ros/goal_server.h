// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <functional>
#include <memory>
#include <string>

#include "sarn_common/pose2d.h"

namespace sarn_navigation {

/// Goals as move_base takes them: the action move_base and the topic move_base_simple/goal.
class GoalServer {
 public:
  struct Handlers {
    std::function<std::string(const sarn::Pose2D&)>
        accept;  // why a goal in the planning frame is refused, or empty
    std::function<void()> cancel;
  };

  GoalServer(ros::NodeHandle nh, tf2_ros::Buffer& buffer, std::string global_frame, Handlers handlers);

  void publishFeedback(const sarn::Pose2D& robot, const ros::Time& stamp);
  void succeed();
  void abort(const std::string& reason);
  [[nodiscard]] bool active() { return server_.isActive(); }

 private:
  void onGoal();
  void onPreempt();
  void onSimpleGoal(const geometry_msgs::PoseStamped& goal);
  [[nodiscard]] std::string toGlobalFrame(const geometry_msgs::PoseStamped& goal,
                                          sarn::Pose2D& goal_in_map) const;

  ros::NodeHandle nh_;
  tf2_ros::Buffer& buffer_;
  std::string global_frame_;
  Handlers handlers_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_;
  ros::Publisher action_goal_;
  ros::Publisher current_goal_;
  ros::Subscriber simple_goal_;
};

}  // namespace sarn_navigation
