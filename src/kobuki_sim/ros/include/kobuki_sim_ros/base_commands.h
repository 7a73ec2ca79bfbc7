// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <kobuki_msgs/ControllerInfo.h>
#include <kobuki_msgs/DigitalOutput.h>
#include <kobuki_msgs/ExternalPower.h>
#include <kobuki_msgs/Led.h>
#include <kobuki_msgs/MotorPower.h>
#include <kobuki_msgs/Sound.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <std_msgs/Empty.h>

#include <cstdint>
#include <string>

#include "kobuki_sim/world.h"

namespace kobuki_sim {

/// The command topics of a Kobuki, passed to the world's base. Lights, sounds, digital outputs and power
/// outputs are checked as the driver checks them; there is nothing in the world for them to act on.
class BaseCommands {
 public:
  /// `world` must outlive this.
  BaseCommands(ros::NodeHandle& nh, World& world);

  /// Warns, once an event, that velocity commands have stopped coming and the robot stands; call it at every
  /// step.
  void warnOfTimeout();

 private:
  void onVelocity(const geometry_msgs::Twist& message);
  void onMotorPower(const kobuki_msgs::MotorPower& message);
  void onResetOdometry(const std_msgs::Empty& message);
  void onLed(const std::string& topic, const kobuki_msgs::Led& message);
  void onSound(const kobuki_msgs::Sound& message);
  void onDigitalOutput(const kobuki_msgs::DigitalOutput& message);
  void onExternalPower(const kobuki_msgs::ExternalPower& message);
  void onControllerInfo(const kobuki_msgs::ControllerInfo& message);

  World& world_;
  std::uint64_t timeout_count_ = 0;
  ros::Publisher controller_info_;
  ros::Subscriber velocity_, motor_power_, reset_odometry_, led1_, led2_, sound_;
  ros::Subscriber digital_output_, external_power_, controller_info_command_;
};

}  // namespace kobuki_sim
