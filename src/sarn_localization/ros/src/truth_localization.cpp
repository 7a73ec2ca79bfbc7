// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/truth_localization.h"

#include <geometry_msgs/TransformStamped.h>

#include <cstdint>
#include <utility>

#include "sarn_common_ros/conversions.h"
#include "sarn_localization_ros/topics.h"

namespace sarn_localization {
namespace {

constexpr double kWarningPeriod = 5.0;  // [s] between repeated warnings
constexpr std::uint32_t kQueueSize = 100;

/// The pose of an odometry message in `frame`; nothing, with a warning, when it is not usable.
std::optional<sarn::Pose2D> usablePose(const nav_msgs::Odometry& message, const char* topic,
                                       const std::string& frame) {
  if (message.header.frame_id != frame) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": frame_id is '" << message.header.frame_id
                                                   << "', expected '" << frame << "'; message ignored");
    return std::nullopt;
  }
  const auto pose = sarn::fromMessage(message.pose.pose);
  if (!pose) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": pose holds NaN or is not planar; message ignored");
  }
  return pose;
}

std::int64_t nanoseconds(const ros::Time& stamp) { return static_cast<std::int64_t>(stamp.toNSec()); }

}  // namespace

TruthLocalization::TruthLocalization(ros::NodeHandle& nh, TruthLocalizationParams params)
    : params_(std::move(params)),
      matcher_(kQueueSize),
      lockstep_(nh, kLockstepTopic),
      truth_subscriber_(nh.subscribe(kTruthTopic, kQueueSize, &TruthLocalization::onTruth, this)),
      odometry_subscriber_(nh.subscribe(kOdometryTopic, kQueueSize, &TruthLocalization::onOdometry, this)) {}

void TruthLocalization::onTruth(const nav_msgs::Odometry& message) {
  const auto pose = usablePose(message, kTruthTopic, params_.global_frame_id);
  if (!pose) return;
  if (const auto pair = matcher_.addTruth(nanoseconds(message.header.stamp), *pose)) broadcast(*pair);
}

void TruthLocalization::onOdometry(const nav_msgs::Odometry& message) {
  const auto pose = usablePose(message, kOdometryTopic, params_.odom_frame_id);
  if (!pose) return;
  if (const auto pair = matcher_.addOdometry(nanoseconds(message.header.stamp), *pose)) broadcast(*pair);
}

void TruthLocalization::broadcast(const PosePair& pair) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp.fromNSec(static_cast<std::uint64_t>(pair.stamp));
  transform.header.frame_id = params_.global_frame_id;
  transform.child_frame_id = params_.odom_frame_id;
  transform.transform = sarn::toTransformMessage(mapFromOdom(pair));
  broadcaster_.sendTransform(transform);
  lockstep_.acknowledge(transform.header.stamp);
}

}  // namespace sarn_localization
