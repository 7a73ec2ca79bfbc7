// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/localization_node.h"

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/TransformStamped.h>

#include <stdexcept>

#include "sarn_common_ros/conversions.h"
#include "sarn_localization_ros/conversions.h"
#include "sarn_localization_ros/topics.h"

namespace sarn_localization {
namespace {

constexpr double kWarningPeriod = 5.0;  // [s] between repeated warnings
constexpr double kFuture = 1.0;         // [s] a scan may be stamped ahead of the clock
constexpr std::uint32_t kScanQueue = 10;

}  // namespace

LocalizationNode::LocalizationNode(ros::NodeHandle& nh, const LocalizationParams& params)
    : params_(params),
      localizer_(params),
      order_(kFuture),
      listener_(transforms_),
      pose_publisher_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>(kPoseTopic, 2, true)),
      particle_publisher_(nh.advertise<geometry_msgs::PoseArray>(kParticleTopic, 2, true)),
      global_localization_(
          nh.advertiseService(kGlobalLocalizationService, &LocalizationNode::onGlobalLocalization, this)),
      lockstep_(nh, kLocalizationLockstepTopic),
      map_subscriber_(nh.subscribe(kMapTopic, 1, &LocalizationNode::onMap, this)),
      initial_pose_subscriber_(nh.subscribe(kInitialPoseTopic, 2, &LocalizationNode::onInitialPose, this)),
      scan_subscriber_(nh, kScanTopic, kScanQueue),
      scans_(scan_subscriber_, transforms_, params_.odom_frame_id, kScanQueue, nh) {
  scans_.registerCallback([this](const sensor_msgs::LaserScanConstPtr& scan) { onScan(scan); });
  scans_.registerFailureCallback([this](const sensor_msgs::LaserScanConstPtr& scan, auto reason) {
    onScanWithoutTransform(scan, reason);
  });
  if (params_.set_initial_pose) {
    PoseEstimate start{{params_.initial_pose_x, params_.initial_pose_y, params_.initial_pose_a},
                       Eigen::Matrix3d::Zero()};
    start.covariance.diagonal() << params_.initial_cov_xx, params_.initial_cov_yy, params_.initial_cov_aa;
    localizer_.setPose(start, sarn::Pose2D{});
  }
}

void LocalizationNode::onMap(const nav_msgs::OccupancyGrid& message) {
  const auto map = sarn::fromMessage(message);
  if (!map || message.header.frame_id != params_.global_frame_id) {
    ROS_ERROR_STREAM_THROTTLE(
        kWarningPeriod, map_subscriber_.getTopic()
                            << ": a map in frame '" << message.header.frame_id << "' of "
                            << message.info.width << " x " << message.info.height << " cells of "
                            << message.info.resolution << " m with " << message.data.size()
                            << " values cannot be used; expected frame '" << params_.global_frame_id
                            << "', as many values as cells, an origin that is not turned; the old map stays");
    return;
  }
  try {
    localizer_.setMap(*map);
    ROS_INFO_STREAM("localising in a map of " << map->geometry.width << " x " << map->geometry.height
                                              << " cells of " << map->geometry.resolution << " m");
  } catch (const std::invalid_argument& error) {
    ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, map_subscriber_.getTopic() << ": " << error.what());
  }
}

void LocalizationNode::onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const auto pose = fromMessage(message.pose);
  if (!pose || message.header.frame_id != params_.global_frame_id) {
    ROS_WARN_STREAM_THROTTLE(
        kWarningPeriod, initial_pose_subscriber_.getTopic()
                            << ": a planar pose with finite values in frame '" << params_.global_frame_id
                            << "' is expected, this one is in '" << message.header.frame_id << "'; ignored");
    return;
  }
  // Where the odometry was when the pose was true; when that is not known, where it is now.
  const bool known =
      transforms_.canTransform(params_.odom_frame_id, params_.base_frame_id, message.header.stamp);
  const auto robot_in_odom =
      lookUp(params_.odom_frame_id, params_.base_frame_id, known ? message.header.stamp : ros::Time());
  localizer_.setPose(*pose, robot_in_odom.value_or(sarn::Pose2D{}));
  ROS_INFO_STREAM("initial pose (" << pose->pose.x << ", " << pose->pose.y << ", " << pose->pose.theta
                                   << ")");
}

bool LocalizationNode::onGlobalLocalization(std_srvs::Empty::Request& /*request*/,
                                            std_srvs::Empty::Response& /*response*/) {
  ROS_INFO("global localization: the robot may be anywhere in the map");
  localizer_.localizeGlobally();
  return true;
}

void LocalizationNode::onScan(const sensor_msgs::LaserScanConstPtr& scan) {
  if (usable(*scan)) use(*scan);
  lockstep_.acknowledge(scan->header.stamp);
}

void LocalizationNode::onScanWithoutTransform(
    const sensor_msgs::LaserScanConstPtr& scan,
    tf2_ros::filter_failure_reasons::FilterFailureReason /*reason*/) {
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, scan_subscriber_.getTopic()
                                               << ": no transform from '" << scan->header.frame_id << "' to '"
                                               << params_.odom_frame_id << "' at the scan's stamp "
                                               << scan->header.stamp << "; scan ignored");
}

bool LocalizationNode::usable(const sensor_msgs::LaserScan& scan) {
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

std::optional<sarn::Pose2D> LocalizationNode::lookUp(const std::string& parent, const std::string& child,
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

void LocalizationNode::use(const sensor_msgs::LaserScan& scan) {
  if (!localizer_.hasMap()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, map_subscriber_.getTopic() << ": no map yet; scans wait for it");
  }
  const auto base_from_sensor = lookUp(params_.base_frame_id, scan.header.frame_id, scan.header.stamp);
  const auto robot_in_odom = lookUp(params_.odom_frame_id, params_.base_frame_id, scan.header.stamp);
  if (!base_from_sensor || !robot_in_odom) return;
  const ScanBeams beams =
      selectBeams(fromMessage(scan), *base_from_sensor,
                  {static_cast<std::size_t>(params_.laser_max_beams), params_.laser_min_range,
                   params_.laser_max_range, params_.laser_range_bias});
  if (localizer_.addScan(*robot_in_odom, beams)) publishPose(scan.header.stamp);
  broadcast(scan.header.stamp);
}

void LocalizationNode::publishPose(const ros::Time& stamp) {
  const auto estimate = localizer_.estimate();
  if (!estimate) return;
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = stamp;
  pose.header.frame_id = params_.global_frame_id;
  pose.pose = toMessage(*estimate);
  pose_publisher_.publish(pose);
  if (particle_publisher_.getNumSubscribers() == 0) return;
  geometry_msgs::PoseArray particles = toMessage(localizer_.particles());
  particles.header = pose.header;
  particle_publisher_.publish(particles);
}

void LocalizationNode::broadcast(const ros::Time& stamp) {
  const auto map_from_odom = localizer_.mapFromOdom();
  if (!params_.tf_broadcast || !map_from_odom) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp + ros::Duration(params_.transform_tolerance);
  transform.header.frame_id = params_.global_frame_id;
  transform.child_frame_id = params_.odom_frame_id;
  transform.transform = sarn::toTransformMessage(*map_from_odom);
  broadcaster_.sendTransform(transform);
}

}  // namespace sarn_localization
