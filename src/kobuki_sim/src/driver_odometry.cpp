// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/driver_odometry.h"

namespace kobuki_sim {
namespace {

constexpr double kCentidegree = sarn::kPi / 18000.0;  // [rad]

/// Ticks from one reading to the next; right across the wrap for less than half a range of motion.
double tickDifference(std::uint16_t from, std::uint16_t to) {
  return static_cast<double>(static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from)));
}

}  // namespace

DriverOdometry::DriverOdometry(double wheel_separation, double wheel_radius, double ticks_per_metre)
    : wheel_separation_(wheel_separation), wheel_radius_(wheel_radius), ticks_per_metre_(ticks_per_metre) {}

void DriverOdometry::reset() {
  pose_ = {};
  wheel_angles_ = {};
  wheel_rates_ = {};
  gyro_offset_ = gyro_angle_;
  gyro_heading_ = 0.0;
}

void DriverOdometry::update(const SensorPacket& packet, double dt) {
  gyro_angle_ = packet.angle * kCentidegree;
  if (!started_) {
    started_ = true;
    gyro_offset_ = gyro_angle_;
    last_left_ = packet.left_encoder;
    last_right_ = packet.right_encoder;
  }
  const double left = tickDifference(last_left_, packet.left_encoder) / ticks_per_metre_;
  const double right = tickDifference(last_right_, packet.right_encoder) / ticks_per_metre_;
  last_left_ = packet.left_encoder;
  last_right_ = packet.right_encoder;

  const double turn = (right - left) / wheel_separation_;
  const sarn::Pose2D arc = sarn::advance({}, {0.5 * (left + right), turn}, 1.0);
  pose_ = pose_ * arc;
  gyro_heading_ = sarn::wrapAngle(gyro_angle_ - gyro_offset_);
  if (use_gyro_heading_) pose_.theta = gyro_heading_;

  velocity_x_ = arc.x / dt;
  velocity_y_ = arc.y / dt;
  yaw_rate_ = use_gyro_heading_ ? packet.angle_rate * kCentidegree : turn / dt;
  wheel_angles_[0] += left / wheel_radius_;
  wheel_angles_[1] += right / wheel_radius_;
  wheel_rates_ = {left / wheel_radius_ / dt, right / wheel_radius_ / dt};
}

}  // namespace kobuki_sim
