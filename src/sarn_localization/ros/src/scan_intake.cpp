// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/scan_intake.h"

#include <utility>

#include "sarn_common_ros/conversions.h"
#include "sarn_localization_ros/conversions.h"
#include "sarn_localization_ros/topics.h"

namespace sarn_localization {
namespace {

constexpr double kWarningPeriod = 5.0;  // [s] between repeated warnings
constexpr double kFuture = 1.0;         // [s] a scan may be stamped ahead of the clock
constexpr std::uint32_t kScanQueue = 10;

}  // namespace

ScanIntake::ScanIntake(ros::NodeHandle& nh, std::string odom_frame, std::string base_frame,
                       const std::string& lockstep_topic, Use use)
    : odom_frame_(std::move(odom_frame)),
      base_frame_(std::move(base_frame)),
      use_(std::move(use)),
      order_(kFuture),
      listener_(transforms_),
      lockstep_(nh, lockstep_topic),
      scan_subscriber_(nh, kScanTopic, kScanQueue),
      scans_(scan_subscriber_, transforms_, odom_frame_, kScanQueue, nh) {
  scans_.registerCallback([this](const sensor_msgs::LaserScanConstPtr& scan) { onScan(scan); });
  scans_.registerFailureCallback(
      [this](const sensor_msgs::LaserScanConstPtr& scan, auto /*reason*/) { onScanWithoutTransform(scan); });
}

void ScanIntake::onScan(const sensor_msgs::LaserScanConstPtr& scan) {
  if (usable(*scan)) {
    const auto base_from_sensor = lookUp(base_frame_, scan->header.frame_id, scan->header.stamp);
    const auto robot_in_odom = lookUp(odom_frame_, base_frame_, scan->header.stamp);
    if (base_from_sensor && robot_in_odom) {
      use_({scan->header.stamp, fromMessage(*scan), *base_from_sensor, *robot_in_odom});
    }
  }
  lockstep_.acknowledge(scan->header.stamp);
}

void ScanIntake::onScanWithoutTransform(const sensor_msgs::LaserScanConstPtr& scan) {
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, scan_subscriber_.getTopic()
                                               << ": no transform from '" << scan->header.frame_id << "' to '"
                                               << odom_frame_ << "' at the scan's stamp "
                                               << scan->header.stamp << "; scan ignored");
}

bool ScanIntake::usable(const sensor_msgs::LaserScan& scan) {
  const std::string topic = scan_subscriber_.getTopic();
  const std::string problem = scanProblem(scan);
  if (!problem.empty()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": " << problem << "; scan ignored");
    return false;
  }
  switch (order_.check(scan.header.stamp, ros::Time::now())) {
    case ScanOrder::kNext:
      break;
    case ScanOrder::kClockJumpedBack:
      ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": the clock jumped back; scans count anew");
      return false;
    case ScanOrder::kOutOfOrder:
      ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": stamp " << scan.header.stamp
                                                     << " is not after the last one; scan ignored");
      return false;
    case ScanOrder::kFuture:
      ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": stamp " << scan.header.stamp << " is more than "
                                                     << kFuture << " s ahead of the clock; scan ignored");
      return false;
  }
  if (beam_count_ != 0 && beam_count_ != scan.ranges.size()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": " << scan.ranges.size() << " beams, before it were "
                                                   << beam_count_ << "; taken as they are");
  }
  beam_count_ = scan.ranges.size();
  return true;
}

std::optional<sarn::Pose2D> ScanIntake::lookUp(const std::string& parent, const std::string& child,
                                               const ros::Time& stamp) {
  try {
    const auto pose = sarn::fromMessage(transforms_.lookupTransform(parent, child, stamp).transform);
    if (!pose) {
      ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "tf: '" << child << "' in '" << parent
                                                       << "' holds NaN or is not upright and planar");
    }
    return pose;
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "tf: " << error.what());
    return std::nullopt;
  }
}

std::optional<sarn::Pose2D> ScanIntake::robotInOdom(const ros::Time& stamp) {
  const bool known = transforms_.canTransform(odom_frame_, base_frame_, stamp);
  return lookUp(odom_frame_, base_frame_, known ? stamp : ros::Time());
}

}  // namespace sarn_localization
