// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "kobuki_sim/kobuki_sensors.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// The odometry of the Kobuki's ROS driver: x and y from the arc of the encoders, the heading overwritten by
/// the gyro.
class DriverOdometry {
 public:
  DriverOdometry(double wheel_separation, double wheel_radius, double ticks_per_metre);

  /// Takes the next packet, `dt` [s] > 0 after the last one. The first packet only sets the zeros.
  void update(const SensorPacket& packet, double dt);
  /// Pose and wheel angles become zero; the gyro's angle of the last packet becomes the new zero.
  void reset();
  /// true (default): heading from the gyro; false: from the encoders.
  void useGyroHeading(bool use) { use_gyro_heading_ = use; }

  [[nodiscard]] const sarn::Pose2D& pose() const { return pose_; }  // odom -> base_footprint
  /// Velocity in base_footprint. vy is the arc's small sideways part, as the driver publishes it.
  [[nodiscard]] double velocityX() const { return velocity_x_; }      // [m/s]
  [[nodiscard]] double velocityY() const { return velocity_y_; }      // [m/s]
  [[nodiscard]] double yawRate() const { return yaw_rate_; }          // [rad/s] from the gyro
  [[nodiscard]] double gyroHeading() const { return gyro_heading_; }  // [rad] since the last reset
  /// left, right
  [[nodiscard]] const std::array<double, 2>& wheelAngles() const { return wheel_angles_; }  // [rad]
  [[nodiscard]] const std::array<double, 2>& wheelRates() const { return wheel_rates_; }    // [rad/s]

 private:
  double wheel_separation_;  // [m]
  double wheel_radius_;      // [m]
  double ticks_per_metre_;   // [tick/m]
  bool use_gyro_heading_ = true;
  bool started_ = false;
  std::uint16_t last_left_ = 0;   // [tick]
  std::uint16_t last_right_ = 0;  // [tick]
  double gyro_angle_ = 0.0;       // [rad] of the last packet
  double gyro_offset_ = 0.0;      // [rad]
  double gyro_heading_ = 0.0;     // [rad]
  sarn::Pose2D pose_;
  double velocity_x_ = 0.0;
  double velocity_y_ = 0.0;
  double yaw_rate_ = 0.0;
  std::array<double, 2> wheel_angles_{};
  std::array<double, 2> wheel_rates_{};
};

}  // namespace kobuki_sim
