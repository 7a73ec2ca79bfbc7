// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>
#include <string>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_localization/parameters.h"
#include "sarn_localization/pose_pair_matcher.h"

namespace sarn_localization {

/// Broadcasts map -> odom so that map -> base_footprint is exactly the simulator's ground truth: one
/// transform for each pair of ground truth and odometry with equal stamps, so a reset of the odometry shows
/// in the very next transform.
class TruthLocalization {
 public:
  TruthLocalization(ros::NodeHandle& nh, TruthLocalizationParams params);

 private:
  void onTruth(const nav_msgs::Odometry& message);
  void onOdometry(const nav_msgs::Odometry& message);
  void broadcast(const PosePair& pair);

  TruthLocalizationParams params_;
  PosePairMatcher matcher_;
  sarn::LockstepAcknowledger lockstep_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Subscriber truth_subscriber_;
  ros::Subscriber odometry_subscriber_;
};

}  // namespace sarn_localization
