// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/path_messages.h"

#include <stdexcept>

#include "sarn_common_ros/conversions.h"

namespace sarn_move_base {

std::vector<geometry_msgs::PoseStamped> toMessages(const TimedPlan& plan, const std::string& frame) {
  std::vector<geometry_msgs::PoseStamped> messages;
  for (const StampedPose& pose : encode(plan)) {
    geometry_msgs::PoseStamped message;
    message.header.frame_id = frame;
    message.header.stamp = ros::Time(pose.t);
    message.pose = sarn::toMessage(pose.pose);
    messages.push_back(message);
  }
  return messages;
}

std::vector<StampedPose> fromMessages(const std::vector<geometry_msgs::PoseStamped>& plan) {
  std::vector<StampedPose> poses;
  for (const geometry_msgs::PoseStamped& message : plan) {
    const std::string& frame = message.header.frame_id;
    const std::string which = "pose " + std::to_string(poses.size()) + " of the plan";
    if (frame != plan.front().header.frame_id) {
      throw std::invalid_argument(which + " is in frame '" + frame + "', the first one in '" +
                                  plan.front().header.frame_id + "'");
    }
    const auto pose = sarn::fromMessage(message.pose);
    if (!pose) throw std::invalid_argument(which + " is not finite or its rotation is not about z");
    poses.push_back({*pose, message.header.stamp.toSec()});
  }
  return poses;
}

}  // namespace sarn_move_base
