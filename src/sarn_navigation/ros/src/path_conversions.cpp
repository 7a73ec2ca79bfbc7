// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/path_conversions.h"

#include "sarn_common_ros/conversions.h"

namespace sarn_navigation {

nav_msgs::Path toPath(const sarn::TimedTrajectory& trajectory, const std::string& frame) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  if (!trajectory.empty()) path.header.stamp = ros::Time(trajectory.startTime());
  for (const auto& point : trajectory.points) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = frame;
    pose.header.stamp = ros::Time(point.t);
    pose.pose = sarn::toMessage(point.pose());
    path.poses.push_back(pose);
  }
  return path;
}

std::uint8_t toMessage(lattice_planner::PlanStatus status) {
  switch (status) {
    case lattice_planner::PlanStatus::kComplete:
      return sarn_msgs::TimedTrajectory::COMPLETE;
    case lattice_planner::PlanStatus::kGoalAnyPose:
      return sarn_msgs::TimedTrajectory::GOAL_ANY_POSE;
    case lattice_planner::PlanStatus::kPartial:
      return sarn_msgs::TimedTrajectory::PARTIAL;
    case lattice_planner::PlanStatus::kNoPath:
      return sarn_msgs::TimedTrajectory::STANDSTILL;
    case lattice_planner::PlanStatus::kStartOccupied:
      return sarn_msgs::TimedTrajectory::START_OCCUPIED;
    case lattice_planner::PlanStatus::kGoalOccupied:
      return sarn_msgs::TimedTrajectory::GOAL_OCCUPIED;
    case lattice_planner::PlanStatus::kGoalUnknown:
      return sarn_msgs::TimedTrajectory::GOAL_UNKNOWN;
    case lattice_planner::PlanStatus::kGoalOutsideMap:
      return sarn_msgs::TimedTrajectory::GOAL_OUTSIDE_MAP;
    case lattice_planner::PlanStatus::kStartOutsideMap:
      return sarn_msgs::TimedTrajectory::START_OUTSIDE_MAP;
    case lattice_planner::PlanStatus::kInvalidRequest:
      return sarn_msgs::TimedTrajectory::INVALID_REQUEST;
  }
  return sarn_msgs::TimedTrajectory::INVALID_REQUEST;
}

sarn_msgs::NavigationStatus toMessage(const NavigatorStatus& status, const std::string& frame,
                                      const ros::Time& stamp) {
  sarn_msgs::NavigationStatus message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.state = static_cast<std::uint8_t>(status.state);
  message.reason = status.reason;
  message.distance_to_goal = status.distance_to_goal;
  message.plan_status = toMessage(status.plan_status);
  message.planning_time = status.planning_time;
  message.expansions = static_cast<std::uint32_t>(status.expansions);
  message.deadline_misses = status.deadline_misses;
  message.people_near = status.people_near;
  return message;
}

}  // namespace sarn_navigation
