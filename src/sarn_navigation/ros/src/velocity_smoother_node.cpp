// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/velocity_smoother_node.h"

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_navigation_ros/topics.h"
#include "sarn_navigation_ros/velocity_conversions.h"

namespace sarn_navigation {

VelocitySmootherNode::VelocitySmootherNode(const ros::NodeHandle&, const ros::NodeHandle& private_nh)
    : private_nh_(private_nh),
      params_(sarn::readParameters<VelocitySmootherParams>(private_nh_)),
      smoother_(params_),
      lockstep_(private_nh_, topics::kSmootherLockstep) {
  output_ = private_nh_.advertise<geometry_msgs::Twist>(topics::kSmootherOutput, 10);
  subscribe();
  timer_ = private_nh_.createTimer(ros::Duration(1.0 / params_.frequency),
                                   [this](const ros::TimerEvent&) { onTimer(); });
}

void VelocitySmootherNode::subscribe() {
  input_ = private_nh_.subscribe<geometry_msgs::Twist>(
      topics::kSmootherInput, 10, [this](const geometry_msgs::TwistConstPtr& command) { onInput(*command); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  const auto source = static_cast<RobotFeedback>(params_.robot_feedback);
  if (source == RobotFeedback::kOdometry) {
    feedback_ = private_nh_.subscribe<nav_msgs::Odometry>(
        topics::kSmootherOdometry, 10,
        [this](const nav_msgs::OdometryConstPtr& odometry) { onFeedback(odometry->twist.twist, feedback_); });
  } else if (source == RobotFeedback::kEndCommands) {
    feedback_ = private_nh_.subscribe<geometry_msgs::Twist>(
        topics::kSmootherEndCommands, 10,
        [this](const geometry_msgs::TwistConstPtr& command) { onFeedback(*command, feedback_); });
  }
}

void VelocitySmootherNode::complain(const ros::Subscriber& from) {
  if (nan_line_.ready()) ROS_ERROR("%s: a Twist that is not finite was dropped", from.getTopic().c_str());
}

void VelocitySmootherNode::onInput(const geometry_msgs::Twist& command) {
  if (!isFinite(command)) return complain(input_);
  smoother_.setInput(*sarn::fromMessage(command), ros::Time::now().toSec());
}

void VelocitySmootherNode::onFeedback(const geometry_msgs::Twist& feedback, const ros::Subscriber& from) {
  if (!isFinite(feedback)) return complain(from);
  smoother_.setFeedback(*sarn::fromMessage(feedback), ros::Time::now().toSec());
}

void VelocitySmootherNode::onTimer() {
  const ros::Time now = ros::Time::now();
  const auto command = smoother_.update(now.toSec());
  if (command) output_.publish(sarn::toMessage(*command));
  lockstep_.acknowledge(now);
}

}  // namespace sarn_navigation
