// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Time.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "drawn_map.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/warning_counter.h"

namespace sarn_localization {

inline constexpr double kStep = 0.1;  // [s] between scans

inline geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                                 const sarn::Pose2D& pose, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform = sarn::toTransformMessage(pose);
  return message;
}

/// The world of a node that hears scans: clock, odometry and scans of a robot on a circle in the uneven room.
class ScanNodeTest : public testing::Test {
 protected:
  explicit ScanNodeTest(std::string node) : node_(std::move(node)), log_("/" + node_), walls_(unevenRoom()) {}

  void SetUp() override {
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    scan_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
    transforms_ = nh_.subscribe("/tf", 100, &ScanNodeTest::onTransform, this);
    acknowledged_ = nh_.subscribe("lockstep/" + node_, 100, &ScanNodeTest::onAcknowledged, this);
    static_.sendTransform(transform("base_footprint", "camera_depth_frame", kSensor, ros::Time()));
    ASSERT_TRUE(await([this] {
      return scan_.getNumSubscribers() > 0 && acknowledged_.getNumPublishers() > 0 &&
             transforms_.getNumPublishers() > 1 && log_.connected();
    }));
  }

  void onTransform(const tf2_msgs::TFMessage& message) {
    for (const auto& t : message.transforms) {
      if (t.child_frame_id == "odom") map_from_odom_ = t;
    }
  }
  void onAcknowledged(const std_msgs::Time& message) { processed_ = std::max(processed_, message.data); }
  /// Warnings so far that contain a text.
  int warnings(const std::string& text) const { return log_.count(text); }

  template <class Condition>
  static bool await(Condition condition) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(20.0);
    while (ros::ok() && ros::WallTime::now() < deadline) {
      if (condition()) return true;
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
    return condition();
  }

  void tick(double seconds) {
    now_ += ros::Duration(seconds);
    rosgraph_msgs::Clock clock;
    clock.clock = now_;
    clock_.publish(clock);
  }
  void publishOdometry(const ros::Time& stamp) {
    broadcaster_.sendTransform(transform("odom", "base_footprint", odometry_, stamp));
  }
  sensor_msgs::LaserScan scanNow(std::size_t beams = 160) const {
    const PlanarScan ideal = idealScan(walls_, truth_ * kSensor, 1.02, beams);
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = "camera_depth_frame";
    scan.header.stamp = now_;
    scan.angle_min = static_cast<float>(ideal.angle_min);
    scan.angle_increment = static_cast<float>(ideal.angle_increment);
    scan.range_min = 0.1F;
    scan.range_max = 20.0F;
    scan.ranges = ideal.ranges;
    return scan;
  }
  void move() {
    truth_ = sarn::advance(truth_, {0.5, 0.4}, kStep);
    odometry_ = sarn::advance(odometry_, odometry_twist_, kStep);
    tick(kStep);
    publishOdometry(now_);
  }
  /// One step of the drive; until the node has done with its scan.
  void drive(std::size_t beams = 160) {
    move();
    scan_.publish(scanNow(beams));
    ASSERT_TRUE(await([this] { return processed_ >= now_; }));
  }
  double error() const {
    const auto correction = sarn::fromMessage(map_from_odom_->transform);
    const sarn::Pose2D found = *correction * odometry_;
    return (found.position() - truth_.position()).norm() +
           std::abs(sarn::angleDifference(found.theta, truth_.theta));
  }
  static constexpr sarn::Pose2D kSensor{-0.087, 0.0475, 0.0};
  sarn::Twist2D odometry_twist_{0.51, 0.403};  // of the robot's 0.5 m/s and 0.4 rad/s
  std::string node_;
  sarn::WarningCounter log_;
  WallDistance walls_;
  sarn::Pose2D truth_{4.0, 1.3, 0.0};
  sarn::Pose2D odometry_;
  ros::NodeHandle nh_;
  ros::Publisher clock_, scan_;
  ros::Subscriber transforms_, acknowledged_;
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_;
  std::optional<geometry_msgs::TransformStamped> map_from_odom_;
  static inline ros::Time now_{100.0};  // goes on from test to test, as the node lives on
  ros::Time processed_{0.0};
};

}  // namespace sarn_localization
