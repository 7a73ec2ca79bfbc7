// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/cmd_vel_mux_node.h"

#include <std_msgs/String.h>

#include <set>

#include "sarn_common_ros/parameter_reader.h"
#include "sarn_navigation_ros/parameters.h"
#include "sarn_navigation_ros/topics.h"
#include "sarn_navigation_ros/velocity_conversions.h"

namespace sarn_navigation {
namespace {

constexpr double kExpiryPeriod = 0.02;  // [s] how late "idle" may be announced; arbitration itself is exact

MuxConfig load(const std::string& file, const std::string& data, const ros::NodeHandle& private_nh) {
  if (!data.empty()) return parseMuxConfig(data, private_nh.resolveName("yaml_cfg_data"));
  if (!file.empty()) return loadMuxConfig(file);
  throw MuxConfigError(private_nh.resolveName("yaml_cfg_file") +
                       ": must name the file with the list of inputs");
}

}  // namespace

CmdVelMuxNode::CmdVelMuxNode(const ros::NodeHandle&, const ros::NodeHandle& private_nh)
    : private_nh_(private_nh) {
  const auto params = sarn::readParameters<MuxNodeParams>(private_nh_);
  active_ = private_nh_.advertise<std_msgs::String>(topics::kMuxActive, 1, true);
  apply(load(params.yaml_cfg_file, params.yaml_cfg_data, private_nh_));
  effective_.yaml_cfg_file = params.yaml_cfg_file;
  effective_.yaml_cfg_data = params.yaml_cfg_data;
  server_ = std::make_unique<dynamic_reconfigure::Server<CmdVelMuxConfig>>(private_nh_);
  server_->setCallback([this](CmdVelMuxConfig& config, std::uint32_t) { reconfigure(config); });
  expiry_timer_ = private_nh_.createTimer(ros::Duration(kExpiryPeriod), [this](const ros::TimerEvent&) {
    mux_->expire(ros::Time::now().toSec());
    publishActive();
  });
}

void CmdVelMuxNode::apply(const MuxConfig& config) {
  mux_ = std::make_unique<VelocityMux>(config.inputs);
  nan_lines_.assign(config.inputs.size(), LineThrottle());
  subscribers_.clear();
  output_ = private_nh_.advertise<geometry_msgs::Twist>(config.publisher, 10);
  for (std::size_t i = 0; i < config.inputs.size(); ++i) {
    const MuxInput& input = config.inputs[i];
    subscribers_.push_back(private_nh_.subscribe<geometry_msgs::Twist>(
        input.topic, 10, [this, i](const geometry_msgs::TwistConstPtr& command) { onCommand(i, command); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    ROS_INFO("input %s: '%s', priority %d, timeout %.2f s", private_nh_.resolveName(input.topic).c_str(),
             input.name.c_str(), input.priority, input.timeout);
  }
  publishActive();
}

void CmdVelMuxNode::reconfigure(CmdVelMuxConfig& config) {
  if (!started_) {  // the server's first call repeats what the constructor has read
    started_ = true;
    return;
  }
  try {
    apply(load(config.yaml_cfg_file, config.yaml_cfg_data, private_nh_));
    effective_ = config;
  } catch (const MuxConfigError& e) {
    ROS_ERROR("the list of inputs stays as it was: %s", e.what());
    config = effective_;
  }
}

void CmdVelMuxNode::onCommand(std::size_t input, const geometry_msgs::TwistConstPtr& command) {
  if (!isFinite(*command)) {
    if (nan_lines_[input].ready()) {
      ROS_ERROR("%s: a Twist that is not finite was dropped",
                private_nh_.resolveName(mux_->inputs()[input].topic).c_str());
    }
    return;
  }
  if (mux_->offer(input, ros::Time::now().toSec())) output_.publish(command);
  publishActive();
}

void CmdVelMuxNode::publishActive() {
  std_msgs::String message;
  message.data = mux_->activeName();
  if (message.data == published_active_) return;
  published_active_ = message.data;
  active_.publish(message);
}

}  // namespace sarn_navigation
