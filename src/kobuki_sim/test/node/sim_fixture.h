// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sarn_msgs/InjectEvent.h>
#include <sarn_msgs/Reset.h>
#include <sarn_msgs/Step.h>
#include <std_srvs/SetBool.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sarn_common_ros/call_service.h"

namespace kobuki_sim {

inline constexpr double kPatience = 30.0;  // [s] wall: a condition that takes longer has failed

/// Serves callbacks until `condition` holds; whether it did.
template <class Condition>
[[nodiscard]] bool await(Condition condition) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (!condition()) {
    if (!ros::ok() || ros::WallTime::now() > deadline) return false;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return true;
}

/// Everything received on a topic.
template <class Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic)
      : subscriber_(nh_.subscribe<Message>(topic, 1000, [this](const typename Message::ConstPtr& message) {
          messages.push_back(*message);
        })) {}

  [[nodiscard]] bool awaitConnection() const {
    return await([this] { return subscriber_.getNumPublishers() > 0; });
  }
  [[nodiscard]] bool awaitCount(std::size_t count) const {
    return await([this, count] { return messages.size() >= count; });
  }
  std::vector<Message> messages;

 private:
  ros::NodeHandle nh_;
  ros::Subscriber subscriber_;
};

/// A paused simulation at the beginning of a new episode, moved by the step service only.
class PausedSim : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("/kobuki_sim/pause", ros::Duration(-1.0)));
    pause(true);
    sarn_msgs::Reset reset;
    reset.request.keep_seed = 1;
    ASSERT_TRUE(sarn::callService("/kobuki_sim/reset", reset));
    ASSERT_TRUE(await([this] { return velocity_.getNumSubscribers() > 0; }));
    ASSERT_TRUE(truth_.awaitConnection());
    truth_.messages.clear();
  }

  static void pause(bool paused) {
    std_srvs::SetBool call;
    call.request.data = paused ? 1 : 0;
    ASSERT_TRUE(sarn::callService("/kobuki_sim/pause", call));
    ASSERT_TRUE(call.response.success);
  }

  static ros::Time step(std::uint32_t steps) {
    sarn_msgs::Step call;
    call.request.steps = steps;
    EXPECT_TRUE(sarn::callService("/kobuki_sim/step", call));
    EXPECT_TRUE(call.response.success) << call.response.message;
    return call.response.time;
  }

  static sarn_msgs::InjectEvent::Response inject(const std::string& event, bool active) {
    sarn_msgs::InjectEvent call;
    call.request.event = event;
    call.request.active = active ? 1 : 0;
    EXPECT_TRUE(sarn::callService("/kobuki_sim/inject", call));
    return call.response;
  }

  /// One packet of the base further (20 ms); afterwards robot() is its truth.
  void stepPacket() {
    const std::size_t count = truth_.messages.size();
    step(2);
    ASSERT_TRUE(truth_.awaitCount(count + 1));
  }

  /// Steps by packets until the condition holds, for at most `limit` [s] of simulation; whether it did.
  template <class Condition>
  [[nodiscard]] bool stepUntil(Condition condition, double limit) {
    for (int i = 0; i < static_cast<int>(limit / 0.02); ++i) {
      stepPacket();
      if (condition()) return true;
    }
    return false;
  }

  void command(double v, double omega) const {
    geometry_msgs::Twist twist;
    twist.linear.x = v;
    twist.angular.z = omega;
    velocity_.publish(twist);
  }

  /// Steps while sending a command at 50 Hz.
  template <class Condition>
  [[nodiscard]] bool driveUntil(double v, double omega, Condition condition, double limit) {
    return stepUntil(
        [&] {
          command(v, omega);
          return condition();
        },
        limit);
  }

  [[nodiscard]] const nav_msgs::Odometry& robot() const { return truth_.messages.back(); }
  [[nodiscard]] double speed() const { return robot().twist.twist.linear.x; }
  [[nodiscard]] double x() const { return robot().pose.pose.position.x; }

  ros::NodeHandle nh_;
  ros::Publisher velocity_ = nh_.advertise<geometry_msgs::Twist>("/mobile_base/commands/velocity", 10);
  Recorder<nav_msgs::Odometry> truth_{"/ground_truth/odom"};
};

}  // namespace kobuki_sim
