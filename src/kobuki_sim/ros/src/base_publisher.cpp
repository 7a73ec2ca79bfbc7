// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/base_publisher.h"

#include <kobuki_msgs/RobotStateEvent.h>
#include <sensor_msgs/PointCloud2.h>

#include "kobuki_sim_ros/base_diagnostics.h"
#include "kobuki_sim_ros/bumper_cloud.h"
#include "kobuki_sim_ros/conversions.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kStreamQueue = 100;
constexpr std::uint32_t kOdometryQueue = 50;
constexpr std::uint32_t kEventQueue = 100;
constexpr bool kLatched = true;

bool hasListeners(const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; }

template <class Message>
void publishAll(const ros::Publisher& publisher, const std::vector<Message>& messages) {
  for (const auto& message : messages) publisher.publish(message);
}

}  // namespace

BasePublisher::BasePublisher(ros::NodeHandle& nh, const NodeParams& params, double raw_gyro_period)
    : params_(params),
      raw_gyro_period_(raw_gyro_period),
      odometry_(nh.advertise<nav_msgs::Odometry>(kOdometryTopic, kOdometryQueue)),
      joint_states_(nh.advertise<sensor_msgs::JointState>(kJointStatesTopic, kStreamQueue)),
      core_(nh.advertise<kobuki_msgs::SensorState>(kCoreTopic, kStreamQueue)),
      dock_ir_(nh.advertise<kobuki_msgs::DockInfraRed>(kDockIrTopic, kStreamQueue)),
      imu_(nh.advertise<sensor_msgs::Imu>(kImuTopic, kStreamQueue)),
      raw_imu_(nh.advertise<sensor_msgs::Imu>(kRawImuTopic, kStreamQueue)),
      bumper_cloud_(nh.advertise<sensor_msgs::PointCloud2>(kBumperCloudTopic, 10)),
      button_(nh.advertise<kobuki_msgs::ButtonEvent>(kButtonTopic, kEventQueue)),
      bumper_(nh.advertise<kobuki_msgs::BumperEvent>(kBumperTopic, kEventQueue)),
      cliff_(nh.advertise<kobuki_msgs::CliffEvent>(kCliffTopic, kEventQueue)),
      wheel_drop_(nh.advertise<kobuki_msgs::WheelDropEvent>(kWheelDropTopic, kEventQueue)),
      power_system_(nh.advertise<kobuki_msgs::PowerSystemEvent>(kPowerSystemTopic, kEventQueue)),
      digital_input_(nh.advertise<kobuki_msgs::DigitalInputEvent>(kDigitalInputTopic, kEventQueue)),
      robot_state_(nh.advertise<kobuki_msgs::RobotStateEvent>(kRobotStateTopic, kEventQueue, kLatched)),
      version_info_(nh.advertise<kobuki_msgs::VersionInfo>(kVersionInfoTopic, 1, kLatched)),
      diagnostics_(nh.advertise<diagnostic_msgs::DiagnosticArray>(kDiagnosticsTopic, 1)) {
  kobuki_msgs::RobotStateEvent online;
  online.state = kobuki_msgs::RobotStateEvent::ONLINE;
  robot_state_.publish(online);
  version_info_.publish(versionInfo());
}

bool BasePublisher::publish(const KobukiBase& base, const ros::Time& stamp) {
  if (base.packetCount() == packet_count_) return false;
  packet_count_ = base.packetCount();
  publishOdometry(base.odometry(), stamp);
  publishStreams(base, stamp);
  publishEvents(base.packet());
  return true;
}

void BasePublisher::publishOdometry(const DriverOdometry& odometry, const ros::Time& stamp) {
  const nav_msgs::Odometry message = toOdometry(odometry, params_, stamp);
  if (params_.publish_tf) broadcaster_.sendTransform(toTransform(message));
  odometry_.publish(message);
  joint_states_.publish(toJointState(odometry, params_, stamp));
}

void BasePublisher::publishStreams(const KobukiBase& base, const ros::Time& stamp) {
  const SensorPacket& packet = base.packet();
  if (hasListeners(core_)) core_.publish(toSensorState(packet, stamp));
  if (hasListeners(dock_ir_)) dock_ir_.publish(toDockIr(stamp));
  if (hasListeners(imu_)) imu_.publish(toImu(base.odometry(), stamp));
  if (hasListeners(raw_imu_)) publishAll(raw_imu_, toRawImu(packet, raw_gyro_period_, stamp));
  publishBumperCloud(packet, stamp);
}

void BasePublisher::publishBumperCloud(const SensorPacket& packet, const ros::Time& stamp) {
  const bool active = packet.bumper != 0 || packet.cliff != 0;
  // One message more when all is clear again.
  if ((active || cloud_active_) && hasListeners(bumper_cloud_)) {
    bumper_cloud_.publish(bumperCloud(packet.bumper, packet.cliff, stamp));
  }
  cloud_active_ = active;
}

void BasePublisher::publishEvents(const SensorPacket& packet) {
  if (has_last_packet_) {
    const BaseEvents events = changes(last_packet_, packet, params_);
    publishAll(bumper_, events.bumper);
    publishAll(cliff_, events.cliff);
    publishAll(wheel_drop_, events.wheel_drop);
    publishAll(button_, events.button);
    publishAll(power_system_, events.power_system);
    publishAll(digital_input_, events.digital_input);
  }
  last_packet_ = packet;
  has_last_packet_ = true;
}

void BasePublisher::publishDiagnostics(const KobukiBase& base, const ros::Time& stamp) {
  if (!diagnostics_rate_.due(static_cast<std::int64_t>(stamp.toNSec()))) return;
  diagnostics_.publish(toDiagnostics(base, params_, stamp));
}

}  // namespace kobuki_sim
