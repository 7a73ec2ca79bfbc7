// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/base_commands.h"

#include <ros/console.h>

#include "kobuki_sim_ros/conversions.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr double kWarningPeriod = 5.0;  // [s] between repeated warnings

}  // namespace

BaseCommands::BaseCommands(ros::NodeHandle& nh, World& world)
    : world_(world),
      controller_info_(nh.advertise<kobuki_msgs::ControllerInfo>(kControllerInfoTopic, 1, true)),
      velocity_(nh.subscribe(kVelocityTopic, kQueue, &BaseCommands::onVelocity, this,
                             ros::TransportHints().tcpNoDelay())),
      motor_power_(nh.subscribe(kMotorPowerTopic, kQueue, &BaseCommands::onMotorPower, this)),
      reset_odometry_(nh.subscribe(kResetOdometryTopic, kQueue, &BaseCommands::onResetOdometry, this)),
      led1_(nh.subscribe<kobuki_msgs::Led>(kLed1Topic, kQueue,
                                           [this](const auto& message) { onLed(kLed1Topic, *message); })),
      led2_(nh.subscribe<kobuki_msgs::Led>(kLed2Topic, kQueue,
                                           [this](const auto& message) { onLed(kLed2Topic, *message); })),
      sound_(nh.subscribe(kSoundTopic, kQueue, &BaseCommands::onSound, this)),
      digital_output_(nh.subscribe(kDigitalOutputTopic, kQueue, &BaseCommands::onDigitalOutput, this)),
      external_power_(nh.subscribe(kExternalPowerTopic, kQueue, &BaseCommands::onExternalPower, this)),
      controller_info_command_(
          nh.subscribe(kControllerInfoCommandTopic, kQueue, &BaseCommands::onControllerInfo, this)) {
  controller_info_.publish(defaultControllerInfo());
}

void BaseCommands::onVelocity(const geometry_msgs::Twist& message) {
  if (!world_.base().commandVelocity(message.linear.x, message.angular.z)) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "/" << kVelocityTopic << ": linear.x " << message.linear.x
                                                 << ", angular.z " << message.angular.z
                                                 << " is not finite; ignored, the robot stops");
  }
}

void BaseCommands::onMotorPower(const kobuki_msgs::MotorPower& message) {
  if (message.state > kobuki_msgs::MotorPower::ON) {
    ROS_ERROR_STREAM("/" << kMotorPowerTopic << ": state " << int{message.state}
                         << " must be 0 (off) or 1 (on)");
    return;
  }
  world_.base().setMotorPower(message.state == kobuki_msgs::MotorPower::ON);
}

void BaseCommands::onResetOdometry(const std_msgs::Empty&) { world_.base().resetOdometry(); }

void BaseCommands::onLed(const std::string& topic, const kobuki_msgs::Led& message) {
  if (message.value > kobuki_msgs::Led::RED) {
    ROS_WARN_STREAM("/" << topic << ": value " << int{message.value} << " must be 0..3; ignored");
  }
}

void BaseCommands::onSound(const kobuki_msgs::Sound& message) {
  if (message.value > kobuki_msgs::Sound::CLEANINGEND) {
    ROS_WARN_STREAM("/" << kSoundTopic << ": value " << int{message.value} << " must be 0..6; ignored");
  }
}

void BaseCommands::onDigitalOutput(const kobuki_msgs::DigitalOutput&) {}

void BaseCommands::onExternalPower(const kobuki_msgs::ExternalPower& message) {
  const std::string fault = problem(message);
  if (!fault.empty()) ROS_WARN_STREAM("/" << kExternalPowerTopic << ": " << fault << "; ignored");
}

void BaseCommands::onControllerInfo(const kobuki_msgs::ControllerInfo& message) {
  const std::string fault = problem(message);
  if (!fault.empty()) {
    ROS_ERROR_STREAM("/" << kControllerInfoCommandTopic << ": " << fault << "; ignored");
    return;
  }
  const bool defaults = message.type == kobuki_msgs::ControllerInfo::DEFAULT;
  controller_info_.publish(defaults ? defaultControllerInfo() : message);
}

void BaseCommands::warnOfTimeout() {
  const std::uint64_t count = world_.base().timeoutCount();
  if (count > timeout_count_) {
    ROS_WARN_STREAM("/" << kVelocityTopic << ": no command for " << world_.base().params().cmd_vel_timeout
                        << " s, the robot stops");
  }
  timeout_count_ = count;
}

}  // namespace kobuki_sim
