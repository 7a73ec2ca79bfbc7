// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <kobuki_msgs/ControllerInfo.h>
#include <kobuki_msgs/DockInfraRed.h>
#include <kobuki_msgs/ExternalPower.h>
#include <kobuki_msgs/SensorState.h>
#include <kobuki_msgs/VersionInfo.h>
#include <nav_msgs/Odometry.h>
#include <people_msgs/People.h>
#include <ros/time.h>
#include <sarn_msgs/Contact.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>

#include <string>
#include <vector>

#include "kobuki_sim/contact.h"
#include "kobuki_sim/depth_camera.h"
#include "kobuki_sim/driver_odometry.h"
#include "kobuki_sim/kobuki_sensors.h"
#include "kobuki_sim/lidar.h"
#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim_ros/parameters.h"

// Core values -> messages, as a Kobuki's driver fills them. Pure functions.
namespace kobuki_sim {

/// Covariances: pose x, y 0.1, yaw 0.05 from the gyro or 0.2 from the wheels, the rest 1e10; twist all 0.
[[nodiscard]] nav_msgs::Odometry toOdometry(const DriverOdometry& odometry, const NodeParams& params,
                                            const ros::Time& stamp);
[[nodiscard]] geometry_msgs::TransformStamped toTransform(const nav_msgs::Odometry& odometry);
/// Empty frame_id, efforts zero.
[[nodiscard]] sensor_msgs::JointState toJointState(const DriverOdometry& odometry, const NodeParams& params,
                                                   const ros::Time& stamp);
[[nodiscard]] kobuki_msgs::SensorState toSensorState(const SensorPacket& packet, const ros::Time& stamp);
/// Nothing is seen: the world has no dock.
[[nodiscard]] kobuki_msgs::DockInfraRed toDockIr(const ros::Time& stamp);
/// Only yaw and yaw rate are filled; their covariances are 0.05, those of the other axes DBL_MAX.
[[nodiscard]] sensor_msgs::Imu toImu(const DriverOdometry& odometry, const ros::Time& stamp);
/// One message for each raw sample of the packet, oldest first, back-dated by `period` [s] a sample; yaw
/// rates on the gyro's steps of 0.00875 deg/s.
[[nodiscard]] std::vector<sensor_msgs::Imu> toRawImu(const SensorPacket& packet, double period,
                                                     const ros::Time& stamp);

[[nodiscard]] kobuki_msgs::VersionInfo versionInfo();
/// The firmware's own gains.
[[nodiscard]] kobuki_msgs::ControllerInfo defaultControllerInfo();
/// One line that says what is wrong with a command; empty when it is fine.
[[nodiscard]] std::string problem(const kobuki_msgs::ControllerInfo& command);
[[nodiscard]] std::string problem(const kobuki_msgs::ExternalPower& command);

/// Truth: map -> base_footprint, twist in base_footprint.
[[nodiscard]] nav_msgs::Odometry toTruthOdometry(const sarn::Pose2D& robot_in_map, const sarn::Twist2D& twist,
                                                 const std::string& base_frame, const ros::Time& stamp);
/// Everyone present, in map; tags: group, radius [m], model.
[[nodiscard]] people_msgs::People toPeople(const std::vector<PersonState>& people, const ros::Time& stamp);
[[nodiscard]] sarn_msgs::Contact toMessage(const Contact& contact, const ros::Time& stamp);

/// 16UC1 [mm].
[[nodiscard]] sensor_msgs::Image toImage(const DepthImage& image, const ros::Time& stamp);
/// Pinhole without distortion.
[[nodiscard]] sensor_msgs::CameraInfo toCameraInfo(const DepthCameraParams& camera, const ros::Time& stamp);
/// `period` [s] between scans. All beams are of the stamp: time_increment is 0.
[[nodiscard]] sensor_msgs::LaserScan toLaserScan(const LidarScan& scan, double period,
                                                 const ros::Time& stamp);

}  // namespace kobuki_sim
