// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/scan_brake_node.h"

#include <std_msgs/Bool.h>

#include <algorithm>
#include <cmath>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_navigation_ros/topics.h"
#include "sarn_navigation_ros/velocity_conversions.h"

namespace sarn_navigation {
namespace {

constexpr double kTimerPeriod = 0.05;  // [s]
constexpr double kReconsiderPeriod =
    0.1;                            // [s] a command older than this is checked again without being asked
constexpr double kStricter = 1e-3;  // [m/s]
constexpr std::size_t kMaxPendingScans = 10;

bool isStill(const sarn::Twist2D& twist) { return twist.v == 0.0 && twist.omega == 0.0; }

}  // namespace

ScanBrakeNode::ScanBrakeNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      private_nh_(private_nh),
      params_(sarn::readParameters<ScanBrakeNodeParams>(private_nh_)),
      brake_(params_.brake),
      tf_listener_(tf_buffer_) {
  output_ = nh_.advertise<geometry_msgs::Twist>(topics::kBrakeOutput, 10);
  braking_ = private_nh_.advertise<std_msgs::Bool>(topics::kBrakeActive, 1, true);
  publishBraking(false);
  command_subscriber_ = nh_.subscribe<geometry_msgs::Twist>(
      topics::kBrakeInput, 10, [this](const geometry_msgs::TwistConstPtr& command) { onCommand(*command); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  scan_subscriber_ = nh_.subscribe<sensor_msgs::LaserScan>(
      topics::kBrakeScan, 5, [this](const sensor_msgs::LaserScanConstPtr& message) { onScan(message); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  timer_ = nh_.createTimer(ros::Duration(kTimerPeriod), [this](const ros::TimerEvent&) { onTimer(); });
}

void ScanBrakeNode::guardClock(double now) {
  if (!clock_.jumpedBack(now)) return;
  ROS_WARN("the clock jumped back to %.2f s: every scan and command was forgotten", now);
  brake_.reset();
  pending_scans_.clear();
  wanted_.reset();
  sent_time_ = now;
}

void ScanBrakeNode::onCommand(const geometry_msgs::Twist& command) {
  const double now = ros::Time::now().toSec();
  guardClock(now);
  if (isFinite(command)) {
    wanted_ = sarn::fromMessage(command);
  } else {
    if (nan_line_.ready()) {
      ROS_ERROR("%s: a Twist is not finite: the robot stands still", command_subscriber_.getTopic().c_str());
    }
    wanted_ = sarn::Twist2D{};
  }
  wanted_time_ = now;
  digestScans(now);
  send(decide(now), now);
}

void ScanBrakeNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  const double now = ros::Time::now().toSec();
  guardClock(now);
  pending_scans_.push_back(message);
  if (pending_scans_.size() > kMaxPendingScans) pending_scans_.pop_front();
  digestScans(now);
}

void ScanBrakeNode::onTimer() {
  const double now = ros::Time::now().toSec();
  guardClock(now);
  digestScans(now);
  if (!wanted_) return;
  if (now - wanted_time_ > params_.brake.command_timeout) {
    wanted_.reset();
    publishBraking(false);
    return;
  }
  if (now - sent_time_ < kReconsiderPeriod) return;
  const BrakeDecision decision = decide(now);
  const bool stricter = std::abs(decision.twist.v) < std::abs(sent_.v) - kStricter ||
                        std::abs(decision.twist.omega) < std::abs(sent_.omega) - kStricter;
  if (stricter) send(decision, now);
}

void ScanBrakeNode::digestScans(double now) {
  const auto done = [&](const sensor_msgs::LaserScanConstPtr& scan) {
    return digest(*scan) || now - scan->header.stamp.toSec() > params_.brake.scan_timeout;
  };
  pending_scans_.erase(std::remove_if(pending_scans_.begin(), pending_scans_.end(), done),
                       pending_scans_.end());
}

bool ScanBrakeNode::digest(const sensor_msgs::LaserScan& message) {
  const auto scan = fromMessage(message);
  if (!scan) {
    if (scan_line_.ready()) {
      ROS_ERROR("%s: a scan without ranges, or whose angles or range limits are not usable, was dropped",
                scan_subscriber_.getTopic().c_str());
    }
    return true;
  }
  const auto odom_from_sensor = lookUp(message.header.frame_id, message.header.stamp, scan_tf_problem_);
  if (!odom_from_sensor) return false;
  brake_.insertScan(*scan, odom_from_sensor->pose, message.header.stamp.toSec());
  return true;
}

std::optional<ScanBrakeNode::StampedPose> ScanBrakeNode::lookUp(const std::string& frame,
                                                                const ros::Time& stamp,
                                                                std::string& problem) const {
  const std::string frames = "'" + params_.odom_frame + "' -> '" + frame + "'";
  try {
    const auto transform = tf_buffer_.lookupTransform(params_.odom_frame, frame, stamp);
    const auto pose = sarn::fromMessage(transform.transform);
    problem = pose ? "" : "tf " + frames + " is not a rotation about the vertical axis";
    if (!pose) return std::nullopt;
    return StampedPose{*pose, transform.header.stamp.toSec()};
  } catch (const tf2::TransformException& e) {
    problem = "no tf " + frames + ": " + e.what();
    return std::nullopt;
  }
}

std::optional<sarn::Pose2D> ScanBrakeNode::basePose(double now) {
  const auto base = lookUp(params_.base_frame, ros::Time(0), base_tf_problem_);
  if (!base) return std::nullopt;
  if (now - base->stamp <= params_.brake.scan_timeout) return base->pose;
  base_tf_problem_ = "tf '" + params_.odom_frame + "' -> '" + params_.base_frame + "' is older than " +
                     std::to_string(params_.brake.scan_timeout) + " s";
  return std::nullopt;
}

BrakeDecision ScanBrakeNode::decide(double now) { return brake_.limit(*wanted_, basePose(now), now); }

void ScanBrakeNode::send(const BrakeDecision& decision, double now) {
  output_.publish(sarn::toMessage(decision.twist));
  sent_ = decision.twist;
  sent_time_ = now;
  const bool held_back = decision.braking() && !isStill(*wanted_);
  if (held_back) report(decision);
  publishBraking(held_back);
}

void ScanBrakeNode::report(const BrakeDecision& decision) {
  if (decision.reason == BrakeReason::kObstacle || !stop_line_.ready()) return;
  const std::string& tf_problem =
      decision.reason == BrakeReason::kNoPose ? base_tf_problem_ : scan_tf_problem_;
  if (!tf_problem.empty()) {
    ROS_ERROR("the robot stands still: %s", tf_problem.c_str());
  } else {
    ROS_ERROR("the robot stands still: no scan on %s for %.2f s", scan_subscriber_.getTopic().c_str(),
              params_.brake.scan_timeout);
  }
}

void ScanBrakeNode::publishBraking(bool braking) {
  if (published_braking_ == braking) return;
  published_braking_ = braking;
  std_msgs::Bool message;
  message.data = braking;
  braking_.publish(message);
}

}  // namespace sarn_navigation
