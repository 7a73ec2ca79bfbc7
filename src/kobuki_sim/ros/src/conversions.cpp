// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/conversions.h"

#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "kobuki_sim_ros/topics.h"
#include "sarn_common_ros/conversions.h"

namespace kobuki_sim {
namespace {

constexpr double kUnknownVariance = 1e10;                  // z, roll, pitch of the odometry
constexpr double kPositionVariance = 0.1;                  // [m^2]
constexpr double kGyroYawVariance = 0.05;                  // [rad^2]
constexpr double kWheelYawVariance = 0.2;                  // [rad^2]
constexpr double kGyroStep = 0.00875 * sarn::kPi / 180.0;  // [rad/s] one digit of the raw gyro
constexpr std::size_t kDockReceivers = 3;

std_msgs::Header header(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header result;
  result.frame_id = frame;
  result.stamp = stamp;
  return result;
}

const char* name(PersonModel model) {
  switch (model) {
    case PersonModel::kOrca:
      return "orca";
    case PersonModel::kSocialForce:
      return "social_force";
    case PersonModel::kScripted:
      return "scripted";
    case PersonModel::kStanding:
      return "standing";
    case PersonModel::kReplay:
      return "replay";
  }
  return "unknown";
}

people_msgs::Person toMessage(const PersonState& person) {
  people_msgs::Person message;
  message.name = person.name;
  message.position.x = person.position.x();
  message.position.y = person.position.y();
  message.velocity.x = person.velocity.x();
  message.velocity.y = person.velocity.y();
  message.reliability = 1.0;
  message.tagnames = {"group", "radius", "model"};
  message.tags = {person.group, std::to_string(person.radius), name(person.model)};
  return message;
}

}  // namespace

nav_msgs::Odometry toOdometry(const DriverOdometry& odometry, const NodeParams& params,
                              const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header = header(params.odom_frame, stamp);
  message.child_frame_id = params.base_frame;
  message.pose.pose = sarn::toMessage(odometry.pose());
  auto& covariance = message.pose.covariance;
  covariance[0] = covariance[7] = kPositionVariance;
  covariance[14] = covariance[21] = covariance[28] = kUnknownVariance;
  covariance[35] = params.use_imu_heading ? kGyroYawVariance : kWheelYawVariance;
  message.twist.twist.linear.x = odometry.velocityX();
  message.twist.twist.linear.y = odometry.velocityY();
  message.twist.twist.angular.z = odometry.yawRate();
  return message;
}

geometry_msgs::TransformStamped toTransform(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = odometry.child_frame_id;
  transform.transform.translation.x = odometry.pose.pose.position.x;
  transform.transform.translation.y = odometry.pose.pose.position.y;
  transform.transform.translation.z = odometry.pose.pose.position.z;
  transform.transform.rotation = odometry.pose.pose.orientation;
  return transform;
}

sensor_msgs::JointState toJointState(const DriverOdometry& odometry, const NodeParams& params,
                                     const ros::Time& stamp) {
  sensor_msgs::JointState message;
  message.header.stamp = stamp;
  message.name = {params.wheel_left_joint_name, params.wheel_right_joint_name};
  message.position.assign(odometry.wheelAngles().begin(), odometry.wheelAngles().end());
  message.velocity.assign(odometry.wheelRates().begin(), odometry.wheelRates().end());
  message.effort.assign(message.name.size(), 0.0);
  return message;
}

kobuki_msgs::SensorState toSensorState(const SensorPacket& packet, const ros::Time& stamp) {
  kobuki_msgs::SensorState message;
  message.header.stamp = stamp;
  message.time_stamp = packet.time_stamp;
  message.bumper = packet.bumper;
  message.wheel_drop = packet.wheel_drop;
  message.cliff = packet.cliff;
  message.left_encoder = packet.left_encoder;
  message.right_encoder = packet.right_encoder;
  message.left_pwm = packet.left_pwm;
  message.right_pwm = packet.right_pwm;
  message.buttons = packet.buttons;
  message.charger = packet.charger;
  message.battery = packet.battery;
  message.bottom.assign(packet.bottom.begin(), packet.bottom.end());
  message.current.assign(packet.current.begin(), packet.current.end());
  message.over_current = packet.over_current;
  message.digital_input = packet.digital_input;
  message.analog_input.assign(packet.analog_input.begin(), packet.analog_input.end());
  return message;
}

kobuki_msgs::DockInfraRed toDockIr(const ros::Time& stamp) {
  kobuki_msgs::DockInfraRed message;
  message.header = header(kDockIrFrame, stamp);
  message.data.assign(kDockReceivers, 0);
  return message;
}

sensor_msgs::Imu toImu(const DriverOdometry& odometry, const ros::Time& stamp) {
  constexpr double kUnknown = std::numeric_limits<double>::max();
  sensor_msgs::Imu message;
  message.header = header(kGyroFrame, stamp);
  message.orientation = sarn::toMessage(sarn::Pose2D{0.0, 0.0, odometry.gyroHeading()}).orientation;
  message.orientation_covariance[0] = message.orientation_covariance[4] = kUnknown;
  message.orientation_covariance[8] = kGyroYawVariance;
  message.angular_velocity.z = odometry.yawRate();
  message.angular_velocity_covariance[0] = message.angular_velocity_covariance[4] = kUnknown;
  message.angular_velocity_covariance[8] = kGyroYawVariance;
  return message;
}

std::vector<sensor_msgs::Imu> toRawImu(const SensorPacket& packet, double period, const ros::Time& stamp) {
  std::vector<sensor_msgs::Imu> samples;
  const std::size_t count = packet.raw_rates.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ros::Duration age(period * static_cast<double>(count - 1 - i));
    if (stamp.toSec() < age.toSec()) continue;  // before the beginning of time
    sensor_msgs::Imu message;
    message.header = header(kGyroFrame, stamp - age);
    message.angular_velocity.z = kGyroStep * std::round(packet.raw_rates[i] / kGyroStep);
    samples.push_back(message);
  }
  return samples;
}

kobuki_msgs::VersionInfo versionInfo() {
  kobuki_msgs::VersionInfo message;
  message.hardware = "1.0.4";
  message.firmware = "1.2.0";
  message.software = "0.1.0";
  message.udid = {0, 0, 0};
  // Firmware newer than 1.0.0 has both.
  message.features =
      kobuki_msgs::VersionInfo::SMOOTH_MOVE_START | kobuki_msgs::VersionInfo::GYROSCOPE_3D_DATA;
  return message;
}

kobuki_msgs::ControllerInfo defaultControllerInfo() {
  kobuki_msgs::ControllerInfo message;
  message.type = kobuki_msgs::ControllerInfo::DEFAULT;
  message.p_gain = 100.0;
  message.i_gain = 0.1;
  message.d_gain = 2.0;
  return message;
}

std::string problem(const kobuki_msgs::ControllerInfo& command) {
  if (command.type > kobuki_msgs::ControllerInfo::USER_CONFIGURED) {
    return "type " + std::to_string(command.type) + " must be 0 (default) or 1 (user configured)";
  }
  if (command.type == kobuki_msgs::ControllerInfo::DEFAULT) return {};
  for (const double gain : {command.p_gain, command.i_gain, command.d_gain}) {
    if (!(gain >= 0.0 && std::isfinite(gain))) {
      return "gain " + std::to_string(gain) + " must be finite and not negative";
    }
  }
  return {};
}

std::string problem(const kobuki_msgs::ExternalPower& command) {
  if (command.source > kobuki_msgs::ExternalPower::PWR_12V1_5A) {
    return "source " + std::to_string(command.source) + " must be 0..3";
  }
  if (command.state > kobuki_msgs::ExternalPower::ON) {
    return "state " + std::to_string(command.state) + " must be 0 (off) or 1 (on)";
  }
  return {};
}

nav_msgs::Odometry toTruthOdometry(const sarn::Pose2D& robot_in_map, const sarn::Twist2D& twist,
                                   const std::string& base_frame, const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header = header(kMapFrame, stamp);
  message.child_frame_id = base_frame;
  message.pose.pose = sarn::toMessage(robot_in_map);
  message.twist.twist = sarn::toMessage(twist);
  return message;
}

people_msgs::People toPeople(const std::vector<PersonState>& people, const ros::Time& stamp) {
  people_msgs::People message;
  message.header = header(kMapFrame, stamp);
  for (const auto& person : people) {
    if (person.present) message.people.push_back(toMessage(person));
  }
  return message;
}

sarn_msgs::Contact toMessage(const Contact& contact, const ros::Time& stamp) {
  sarn_msgs::Contact message;
  message.header = header(kMapFrame, stamp);
  message.other = contact.other;
  message.point.x = contact.point.x();
  message.point.y = contact.point.y();
  message.robot_closing_speed = contact.robot_closing_speed;
  message.other_closing_speed = contact.other_closing_speed;
  message.robot_speed = contact.robot_speed;
  message.standing_time = contact.standing_time;
  return message;
}

sensor_msgs::Image toImage(const DepthImage& image, const ros::Time& stamp) {
  sensor_msgs::Image message;
  message.header = header(kDepthOpticalFrame, stamp);
  message.width = static_cast<std::uint32_t>(image.width);
  message.height = static_cast<std::uint32_t>(image.height);
  message.encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  message.is_bigendian = 0;
  message.step = message.width * static_cast<std::uint32_t>(sizeof(std::uint16_t));
  message.data.resize(static_cast<std::size_t>(message.step) * message.height);
  std::memcpy(message.data.data(), image.millimetres.data(), message.data.size());
  return message;
}

sensor_msgs::CameraInfo toCameraInfo(const DepthCameraParams& camera, const ros::Time& stamp) {
  sensor_msgs::CameraInfo message;
  message.header = header(kDepthOpticalFrame, stamp);
  message.width = static_cast<std::uint32_t>(camera.width);
  message.height = static_cast<std::uint32_t>(camera.height);
  message.distortion_model = "plumb_bob";
  message.D.assign(5, 0.0);
  message.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  message.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return message;
}

sensor_msgs::LaserScan toLaserScan(const LidarScan& scan, double period, const ros::Time& stamp) {
  sensor_msgs::LaserScan message;
  message.header = header(kLidarFrame, stamp);
  message.angle_min = static_cast<float>(scan.angle_min);
  message.angle_increment = static_cast<float>(scan.angle_increment);
  message.angle_max = static_cast<float>(
      scan.angle_min + scan.angle_increment * (static_cast<double>(scan.ranges.size()) - 1.0));
  message.scan_time = static_cast<float>(period);
  message.range_min = static_cast<float>(scan.range_min);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  return message;
}

}  // namespace kobuki_sim
