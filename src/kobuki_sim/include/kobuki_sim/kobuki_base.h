// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "kobuki_sim/driver_odometry.h"
#include "kobuki_sim/gyro.h"
#include "kobuki_sim/kobuki_params.h"
#include "kobuki_sim/kobuki_sensors.h"
#include "kobuki_sim/random.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// A Kobuki: takes commands as its driver does, turns its wheels with their limits, and measures with its
/// encoders and gyro. Where the body goes is the world's affair:
///
///   const sarn::Twist2D wanted = base.drive();   // what the wheels would do to the body in this step
///   ... the world moves the robot as far as walls and people let it ...
///   base.settle(actual, blocked);                // what really happened; sensors and, each 20 ms, the
///   driver
class KobukiBase {
 public:
  /// `time_step` [s] > 0 is the length of every step. Throws std::invalid_argument on bad parameters.
  KobukiBase(const KobukiParams& params, double time_step, std::uint64_t seed);

  // --- Commands, as on /mobile_base/commands/*
  // ----------------------------------------------------------------------
  /// Forward speed [m/s] and yaw rate [rad/s]. Ignored while the motors are off. Returns false, and stops the
  /// robot, when a value is not finite.
  bool commandVelocity(double v, double omega);
  /// Off: stops, then takes no commands. On: takes commands again.
  void setMotorPower(bool on);
  [[nodiscard]] bool motorPower() const { return motor_power_; }
  void resetOdometry() { odometry_.reset(); }

  // --- Injected events; bits of kobuki_sensors.h
  // ---------------------------------------------------------------------
  void setCliff(std::uint8_t bits) { cliff_ = bits; }
  void setWheelDrop(std::uint8_t bits) { wheel_drop_ = bits; }
  void setButtons(std::uint8_t bits) { buttons_ = bits; }
  void setBatteryCharge(double charge);  // [1] 0 empty .. 1 full
  [[nodiscard]] std::uint8_t cliff() const { return cliff_; }
  [[nodiscard]] std::uint8_t wheelDrop() const { return wheel_drop_; }
  [[nodiscard]] std::uint8_t buttons() const { return buttons_; }

  // --- One step
  // --------------------------------------------------------------------------------------------------------
  /// Twist of the body that the wheels want in this step.
  [[nodiscard]] sarn::Twist2D drive();
  /// Ends the step: `actual` body twist in base_footprint (v: forward part of the real motion), `blocked`:
  /// something held the robot, `bumper` bits pressed.
  void settle(const sarn::Twist2D& actual, bool blocked, std::uint8_t bumper);

  // --- What the driver knows
  // ---------------------------------------------------------------------------------------------
  [[nodiscard]] const SensorPacket& packet() const { return packet_; }
  [[nodiscard]] std::uint64_t packetCount() const { return packet_count_; }  // grows by one with every packet
  [[nodiscard]] const DriverOdometry& odometry() const { return odometry_; }
  [[nodiscard]] DriverOdometry& odometry() { return odometry_; }
  [[nodiscard]] std::uint64_t timeoutCount() const { return timeout_count_; }  // timeouts that stopped it
  [[nodiscard]] bool timedOut() const { return timed_out_; }

  // --- Truth
  // -------------------------------------------------------------------------------------------------------------
  [[nodiscard]] double time() const { return static_cast<double>(steps_) * time_step_; }  // [s]
  [[nodiscard]] const sarn::Twist2D& twist() const { return twist_; }  // real body twist of the last step
  [[nodiscard]] double batteryVoltage() const { return battery_voltage_; }  // [V]
  [[nodiscard]] const KobukiParams& params() const { return params_; }

  /// Feeds every value that shapes the future into a digest: hash(double).
  template <class Hash>
  void digest(Hash&& hash) const;

 private:
  struct Pending {
    std::uint64_t step = 0;  // takes effect at the beginning of this step
    sarn::Twist2D twist;
  };

  [[nodiscard]] bool due(std::uint64_t every) const { return steps_ % every == 0; }
  void checkTimeout();
  void sendCommand();
  void turnWheels();
  void holdWheels(const sarn::Twist2D& actual);
  void measureCurrents(bool blocked);
  void drainBattery();
  void makePacket(std::uint8_t bumper);

  KobukiParams params_;
  double time_step_;                  // [s]
  std::uint64_t steps_per_packet_;    // [steps]
  std::uint64_t steps_per_watchdog_;  // [steps]
  std::uint64_t delay_steps_;         // [steps]
  RandomStream wheel_noise_;
  std::array<double, 2> wheel_scale_{};  // [1] true length per nominal length; left, right
  Gyro gyro_;
  DriverOdometry odometry_;

  std::uint64_t steps_ = 0;
  bool motor_power_ = true;
  bool has_command_ = false;
  bool timed_out_ = false;
  double last_command_time_ = 0.0;  // [s]
  std::uint64_t timeout_count_ = 0;
  sarn::Twist2D command_;  // newest from outside
  sarn::Twist2D sent_;     // newest sent to the firmware
  std::deque<Pending> pending_;
  sarn::Twist2D target_;                        // what the firmware drives at
  std::array<double, 2> wheel_speed_{};         // [m/s] nominal; left, right
  std::array<double, 2> wheel_acceleration_{};  // [m/s^2]
  std::array<double, 2> wheel_step_{};          // [m] nominal length rolled in this step
  std::array<double, 2> wheel_travel_{};        // [m] nominal length rolled, what the encoders count
  sarn::Twist2D wanted_;
  sarn::Twist2D twist_;

  std::uint8_t cliff_ = 0;
  std::uint8_t wheel_drop_ = 0;
  std::uint8_t buttons_ = 0;
  double charge_ = 1.0;                    // [1]
  double battery_voltage_ = 0.0;           // [V]
  std::array<double, 2> motor_current_{};  // [A] left, right
  std::vector<double> raw_rates_;          // [rad/s] since the last packet
  SensorPacket packet_;
  std::uint64_t packet_count_ = 0;
};

template <class Hash>
void KobukiBase::digest(Hash&& hash) const {
  for (const int side : {0, 1}) {
    const auto i = static_cast<std::size_t>(side);
    hash(wheel_speed_[i]);
    hash(wheel_travel_[i]);
    hash(wheel_scale_[i]);
  }
  for (const double value :
       {command_.v, command_.omega, target_.v, target_.omega, twist_.v, twist_.omega, charge_, gyro_.bias(),
        gyro_.angle(), odometry_.pose().x, odometry_.pose().y, odometry_.pose().theta}) {
    hash(value);
  }
}

}  // namespace kobuki_sim
