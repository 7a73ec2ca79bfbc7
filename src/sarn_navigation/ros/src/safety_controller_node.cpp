// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/safety_controller_node.h"

#include <geometry_msgs/Twist.h>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_navigation_ros/topics.h"

namespace sarn_navigation {

static_assert(static_cast<int>(Side::kLeft) == kobuki_msgs::BumperEvent::LEFT &&
              static_cast<int>(Side::kCenter) == kobuki_msgs::BumperEvent::CENTER &&
              static_cast<int>(Side::kRight) == kobuki_msgs::BumperEvent::RIGHT);
static_assert(static_cast<int>(Side::kLeft) == kobuki_msgs::CliffEvent::LEFT &&
              static_cast<int>(Side::kCenter) == kobuki_msgs::CliffEvent::CENTER &&
              static_cast<int>(Side::kRight) == kobuki_msgs::CliffEvent::RIGHT);
static_assert(static_cast<int>(Wheel::kLeft) == kobuki_msgs::WheelDropEvent::LEFT &&
              static_cast<int>(Wheel::kRight) == kobuki_msgs::WheelDropEvent::RIGHT);

namespace {

constexpr int kSides = 3;
constexpr int kWheels = 2;

bool known(int sensor, int count, const char* topic) {
  if (sensor < count) return true;
  ROS_ERROR_THROTTLE(5.0, "%s: sensor %d does not exist (0 to %d)", topic, sensor, count - 1);
  return false;
}

}  // namespace

SafetyControllerNode::SafetyControllerNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      private_nh_(private_nh),
      params_(sarn::readParameters<SafetyControllerParams>(private_nh_)),
      controller_(params_) {
  output_ = nh_.advertise<geometry_msgs::Twist>(topics::kSafetyOutput, 10);
  subscribe();
  timer_ = nh_.createTimer(ros::Duration(1.0 / params_.rate),
                           [this](const ros::TimerEvent&) { publishCommand(); });
}

void SafetyControllerNode::subscribe() {
  subscribers_ = {
      nh_.subscribe<kobuki_msgs::BumperEvent>(
          topics::kBumperEvents, 100,
          [this](const kobuki_msgs::BumperEventConstPtr& event) { onBumper(*event); }),
      nh_.subscribe<kobuki_msgs::CliffEvent>(
          topics::kCliffEvents, 100,
          [this](const kobuki_msgs::CliffEventConstPtr& event) { onCliff(*event); }),
      nh_.subscribe<kobuki_msgs::WheelDropEvent>(
          topics::kWheelDropEvents, 100,
          [this](const kobuki_msgs::WheelDropEventConstPtr& event) { onWheelDrop(*event); }),
      private_nh_.subscribe<std_msgs::Empty>(topics::kSafetyEnable, 10,
                                             [this](const std_msgs::EmptyConstPtr&) { setEnabled(true); }),
      private_nh_.subscribe<std_msgs::Empty>(topics::kSafetyDisable, 10,
                                             [this](const std_msgs::EmptyConstPtr&) { setEnabled(false); }),
      private_nh_.subscribe<std_msgs::Empty>(
          topics::kSafetyReset, 10, [this](const std_msgs::EmptyConstPtr&) { reset("reset was asked for"); }),
  };
}

void SafetyControllerNode::onBumper(const kobuki_msgs::BumperEvent& event) {
  if (!known(event.bumper, kSides, topics::kBumperEvents)) return;
  controller_.setBumper(static_cast<Side>(event.bumper), event.state == kobuki_msgs::BumperEvent::PRESSED,
                        ros::Time::now().toSec());
  publishCommand();
}

void SafetyControllerNode::onCliff(const kobuki_msgs::CliffEvent& event) {
  if (!known(event.sensor, kSides, topics::kCliffEvents)) return;
  controller_.setCliff(static_cast<Side>(event.sensor), event.state == kobuki_msgs::CliffEvent::CLIFF,
                       ros::Time::now().toSec());
  publishCommand();
}

void SafetyControllerNode::onWheelDrop(const kobuki_msgs::WheelDropEvent& event) {
  if (!known(event.wheel, kWheels, topics::kWheelDropEvents)) return;
  controller_.setWheelDrop(static_cast<Wheel>(event.wheel),
                           event.state == kobuki_msgs::WheelDropEvent::DROPPED);
  publishCommand();
}

void SafetyControllerNode::setEnabled(bool enabled) {
  if (enabled == enabled_) return;
  enabled_ = enabled;
  ROS_INFO("safety controller %s", enabled ? "enabled" : "disabled");
}

void SafetyControllerNode::reset(const char* reason) {
  controller_.reset();
  ROS_WARN("every event was forgotten: %s", reason);
}

void SafetyControllerNode::publishCommand() {
  const double now = ros::Time::now().toSec();
  if (clock_.jumpedBack(now)) reset("the clock jumped back");
  if (!enabled_) return;
  const auto command = controller_.command(now);
  if (command) output_.publish(sarn::toMessage(*command));
}

}  // namespace sarn_navigation
