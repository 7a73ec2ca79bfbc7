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

}  // namespace

LocalizationNode::LocalizationNode(ros::NodeHandle& nh, const LocalizationParams& params)
    : params_(params),
      localizer_(params),
      pose_publisher_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>(kPoseTopic, 2, true)),
      particle_publisher_(nh.advertise<geometry_msgs::PoseArray>(kParticleTopic, 2, true)),
      global_localization_(
          nh.advertiseService(kGlobalLocalizationService, &LocalizationNode::onGlobalLocalization, this)),
      map_subscriber_(nh.subscribe(kMapTopic, 1, &LocalizationNode::onMap, this)),
      initial_pose_subscriber_(nh.subscribe(kInitialPoseTopic, 2, &LocalizationNode::onInitialPose, this)),
      intake_(nh, params_.odom_frame_id, params_.base_frame_id, kLocalizationLockstepTopic,
              [this](const ScanIntake::Input& input) { use(input); }) {
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
  // Where the odometry was when the pose was true.
  const auto robot_in_odom = intake_.robotInOdom(message.header.stamp);
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

void LocalizationNode::use(const ScanIntake::Input& input) {
  if (!localizer_.hasMap()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, map_subscriber_.getTopic() << ": no map yet; scans wait for it");
  }
  const ScanBeams beams = selectBeams(input.scan, input.base_from_sensor, beamLimits(params_));
  if (localizer_.addScan(input.robot_in_odom, beams)) publishPose(input.stamp);
  broadcast(input.stamp);
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
