// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/conversions.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>

#include "kobuki_sim_ros/base_diagnostics.h"
#include "kobuki_sim_ros/bumper_cloud.h"
#include "kobuki_sim_ros/injected_events.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

constexpr double kDegree = sarn::kPi / 180.0;
constexpr double kTick = 1.0 / 11724.41658;  // [m]
const ros::Time kStamp(12.5);

template <class Quaternion>
double yaw(const Quaternion& q) {
  return 2.0 * std::atan2(q.z, q.w);
}

/// An odometry that has seen two packets, 20 ms apart.
DriverOdometry movingOdometry() {
  DriverOdometry odometry(0.23, 0.035, 1.0 / kTick);
  SensorPacket packet;
  odometry.update(packet, 0.02);
  packet.left_encoder = 100;
  packet.right_encoder = 120;
  packet.angle = 150;       // 1.5 deg
  packet.angle_rate = 900;  // 9 deg/s
  odometry.update(packet, 0.02);
  return odometry;
}

TEST(ToOdometry, hasTheDriversFramesAndValues) {
  const nav_msgs::Odometry message = toOdometry(movingOdometry(), {}, kStamp);
  EXPECT_EQ(message.header.stamp, kStamp);
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_footprint");
  EXPECT_NEAR(message.pose.pose.position.x, 110.0 * kTick, 1e-4);
  EXPECT_NEAR(yaw(message.pose.pose.orientation), 1.5 * kDegree, 1e-9);
  EXPECT_NEAR(message.twist.twist.linear.x, 110.0 * kTick / 0.02, 1e-3);
  EXPECT_NE(message.twist.twist.linear.y, 0.0) << "the arc's sideways part";
  EXPECT_NEAR(message.twist.twist.angular.z, 9.0 * kDegree, 1e-9);
}

TEST(ToOdometry, hasTheDriversCovariances) {
  NodeParams params;
  const auto message = toOdometry(movingOdometry(), params, kStamp);
  const auto& covariance = message.pose.covariance;
  EXPECT_EQ(covariance[0], 0.1);
  EXPECT_EQ(covariance[7], 0.1);
  EXPECT_EQ(covariance[14], 1e10);
  EXPECT_EQ(covariance[21], 1e10);
  EXPECT_EQ(covariance[28], 1e10);
  EXPECT_EQ(covariance[35], 0.05);
  for (const double value : message.twist.covariance) EXPECT_EQ(value, 0.0);
  params.use_imu_heading = false;
  EXPECT_EQ(toOdometry(movingOdometry(), params, kStamp).pose.covariance[35], 0.2);
}

TEST(ToTransform, repeatsTheOdometry) {
  const nav_msgs::Odometry odometry = toOdometry(movingOdometry(), {}, kStamp);
  const auto transform = toTransform(odometry);
  EXPECT_EQ(transform.header.frame_id, "odom");
  EXPECT_EQ(transform.header.stamp, kStamp);
  EXPECT_EQ(transform.child_frame_id, "base_footprint");
  EXPECT_EQ(transform.transform.translation.x, odometry.pose.pose.position.x);
  EXPECT_EQ(transform.transform.rotation.z, odometry.pose.pose.orientation.z);
}

TEST(ToJointState, namesTheWheelsInNoFrame) {
  constexpr double kTickAngle = 0.00243691687;  // [rad]
  const auto message = toJointState(movingOdometry(), {}, kStamp);
  EXPECT_EQ(message.header.frame_id, "");
  EXPECT_EQ(message.name, (std::vector<std::string>{"wheel_left_joint", "wheel_right_joint"}));
  ASSERT_EQ(message.position.size(), 2U);
  EXPECT_NEAR(message.position[0], 100 * kTickAngle, 1e-5);
  EXPECT_NEAR(message.position[1], 120 * kTickAngle, 1e-5);
  EXPECT_NEAR(message.velocity[1], 120 * kTickAngle / 0.02, 1e-3);
  EXPECT_EQ(message.effort, (std::vector<double>{0.0, 0.0}));
}

TEST(ToImu, fillsOnlyYaw) {
  const auto message = toImu(movingOdometry(), kStamp);
  EXPECT_EQ(message.header.frame_id, "gyro_link");
  for (const auto* covariance : {&message.orientation_covariance, &message.angular_velocity_covariance}) {
    EXPECT_EQ((*covariance)[0], std::numeric_limits<double>::max());
    EXPECT_EQ((*covariance)[4], std::numeric_limits<double>::max());
    EXPECT_EQ((*covariance)[8], 0.05);
  }
  EXPECT_NEAR(message.angular_velocity.z, 9.0 * kDegree, 1e-9);
  EXPECT_NEAR(yaw(message.orientation), 1.5 * kDegree, 1e-9);
}

TEST(ToRawImu, backDatesTheSamplesOfAPacket) {
  SensorPacket packet;
  packet.raw_rates = {0.1, 0.2, 0.3};
  const auto samples = toRawImu(packet, 0.01, kStamp);
  ASSERT_EQ(samples.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(samples[i].header.stamp, kStamp - ros::Duration(0.01 * static_cast<double>(2 - i)));
    const double digits = samples[i].angular_velocity.z / (0.00875 * kDegree);
    EXPECT_NEAR(digits, std::round(digits), 1e-6);
    EXPECT_NEAR(samples[i].angular_velocity.z, packet.raw_rates[i], 0.00875 * kDegree);
  }
}

TEST(ToRawImu, neverStampsBeforeTimeZero) {
  SensorPacket packet;
  packet.raw_rates = {0.1, 0.2, 0.3};
  EXPECT_EQ(toRawImu(packet, 0.01, ros::Time(0.01)).size(), 2U);
}

TEST(ToSensorState, copiesThePacket) {
  SensorPacket packet;
  packet.bumper = 5;
  packet.left_encoder = 65000;
  packet.bottom = {1, 2, 3};
  packet.current = {4, 5};
  packet.battery = 165;
  const auto message = toSensorState(packet, kStamp);
  EXPECT_EQ(message.bumper, 5);
  EXPECT_EQ(message.left_encoder, 65000);
  EXPECT_EQ(message.bottom, (std::vector<std::uint16_t>{1, 2, 3}));
  EXPECT_EQ(message.current, (std::vector<std::uint8_t>{4, 5}));
  EXPECT_EQ(message.battery, 165);
}

TEST(BumperCloud, putsActivePadsOnTheHullAndTheOthersFarAway) {
  const auto cloud = bumperCloud(kLeftBit, kCentreBit, kStamp);
  EXPECT_EQ(cloud.header.frame_id, "base_link");
  ASSERT_EQ(cloud.width * cloud.height, 3U);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2ConstIterator<float> y(cloud, "y");
  EXPECT_NEAR(*x, 0.24 * std::sin(20.0 * kDegree), 1e-6) << "left, a bumper";
  EXPECT_NEAR(*y, 0.24 * std::cos(20.0 * kDegree), 1e-6);
  ++x;
  ++y;
  EXPECT_NEAR(*x, 0.24, 1e-6) << "centre, a cliff";
  EXPECT_NEAR(*y, 0.0, 1e-6);
  ++x;
  ++y;
  EXPECT_GT(std::hypot(*x, *y), 50.0F) << "right, nothing";
  EXPECT_LT(*y, 0.0F);
}

TEST(ToPeople, leavesOutWhoIsNotThereAndTagsTheOthers) {
  PersonState anna;
  anna.name = "anna";
  anna.group = "couple";
  anna.model = PersonModel::kSocialForce;
  anna.position = {1.0, 2.0};
  anna.velocity = {0.5, -0.5};
  anna.radius = 0.3;
  PersonState ghost;
  ghost.name = "ghost";
  ghost.present = false;
  const auto message = toPeople({anna, ghost}, kStamp);
  EXPECT_EQ(message.header.frame_id, "map");
  ASSERT_EQ(message.people.size(), 1U);
  const auto& person = message.people[0];
  EXPECT_EQ(person.name, "anna");
  EXPECT_EQ(person.position.y, 2.0);
  EXPECT_EQ(person.velocity.y, -0.5);
  EXPECT_EQ(person.tagnames, (std::vector<std::string>{"group", "radius", "model"}));
  ASSERT_EQ(person.tags.size(), 3U);
  EXPECT_EQ(person.tags[0], "couple");
  EXPECT_NEAR(std::stod(person.tags[1]), 0.3, 1e-6);
  EXPECT_EQ(person.tags[2], "social_force");
}

TEST(ToCameraInfo, isAPinholeWithoutDistortion) {
  const DepthCameraParams camera;
  const auto info = toCameraInfo(camera, kStamp);
  EXPECT_EQ(info.header.frame_id, "camera_depth_optical_frame");
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_EQ(info.D, std::vector<double>(5, 0.0));
  EXPECT_EQ(info.K[0], 570.3422);
  EXPECT_EQ(info.K[2], 314.5);
  EXPECT_EQ(info.P[5], 570.3422);
  EXPECT_EQ(info.P[6], 235.5);
}

TEST(ToImage, isRowMajorMillimetres) {
  DepthImage image;
  image.width = 2;
  image.height = 2;
  image.millimetres = {1, 2, 3, 1000};
  const auto message = toImage(image, kStamp);
  EXPECT_EQ(message.encoding, "16UC1");
  EXPECT_EQ(message.step, 4U);
  ASSERT_EQ(message.data.size(), 8U);
  EXPECT_EQ(message.data[6] + 256 * message.data[7], 1000);
}

TEST(Problem, namesBadGains) {
  kobuki_msgs::ControllerInfo gains;
  gains.type = kobuki_msgs::ControllerInfo::USER_CONFIGURED;
  EXPECT_EQ(problem(gains), "");
  gains.i_gain = -1.0;
  EXPECT_NE(problem(gains), "");
  gains.i_gain = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(problem(gains), "");
}

TEST(Problem, namesBadPowerSourcesAndStates) {
  kobuki_msgs::ExternalPower power;
  EXPECT_EQ(problem(power), "");
  power.source = 4;
  EXPECT_NE(problem(power), "");
  power.source = 0;
  power.state = 2;
  EXPECT_NE(problem(power), "");
}

TEST(InjectEvent, setsAndClearsOneBitAndRefusesUnknownNames) {
  KobukiBase base({}, 0.01, 1);
  const NodeParams params;
  EXPECT_EQ(injectEvent(base, params, "cliff_left", true), "");
  EXPECT_EQ(injectEvent(base, params, "cliff_right", true), "");
  EXPECT_EQ(base.cliff(), kLeftBit | kRightBit);
  EXPECT_EQ(injectEvent(base, params, "cliff_left", false), "");
  EXPECT_EQ(base.cliff(), kRightBit);
  EXPECT_EQ(injectEvent(base, params, "wheel_drop_left", true), "");
  EXPECT_EQ(base.wheelDrop(), kLeftWheelDropBit);
  EXPECT_EQ(injectEvent(base, params, "button1", true), "");
  EXPECT_EQ(base.buttons(), 2);
  EXPECT_NE(injectEvent(base, params, "earthquake", true).find("earthquake"), std::string::npos);
}

TEST(ToDiagnostics, hasTheNamesAnAggregatorLooksFor) {
  const KobukiBase base({}, 0.01, 1);
  const auto message = toDiagnostics(base, {}, kStamp);
  const std::vector<std::string> tasks = {"Battery",       "Watchdog",      "Wall Sensor", "Cliff Sensor",
                                          "Wheel Drop",    "Motor Current", "Motor State", "Gyro Sensor",
                                          "Digital Input", "Analog Input"};
  ASSERT_EQ(message.status.size(), tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    EXPECT_EQ(message.status[i].name, "mobile_base_nodelet_manager: " + tasks[i]);
    EXPECT_EQ(message.status[i].hardware_id, "Kobuki");
  }
}

TEST(ToDiagnostics, warnsOfMotorsThatAreOff) {
  KobukiBase base({}, 0.01, 1);
  EXPECT_EQ(toDiagnostics(base, {}, kStamp).status[6].level, diagnostic_msgs::DiagnosticStatus::OK);
  base.setMotorPower(false);
  EXPECT_EQ(toDiagnostics(base, {}, kStamp).status[6].level, diagnostic_msgs::DiagnosticStatus::WARN);
}

}  // namespace
}  // namespace kobuki_sim
