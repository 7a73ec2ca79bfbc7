// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace kobuki_sim {

// Bits of SensorPacket::bumper and ::cliff, as in kobuki_msgs/SensorState (the events number them the other
// way).
inline constexpr std::uint8_t kRightBit = 1;
inline constexpr std::uint8_t kCentreBit = 2;
inline constexpr std::uint8_t kLeftBit = 4;
// Bits of SensorPacket::wheel_drop.
inline constexpr std::uint8_t kRightWheelDropBit = 1;
inline constexpr std::uint8_t kLeftWheelDropBit = 2;

/// One stream packet of the base (50 Hz): what a driver knows of the robot, in the robot's own units.
struct SensorPacket {
  double time = 0.0;             // [s] simulation time of the measurement
  std::uint16_t time_stamp = 0;  // [ms] wraps
  std::uint8_t bumper = 0;
  std::uint8_t wheel_drop = 0;
  std::uint8_t cliff = 0;
  std::uint8_t buttons = 0;               // bit i: button i
  std::uint16_t left_encoder = 0;         // [tick] wraps
  std::uint16_t right_encoder = 0;        // [tick] wraps
  std::int8_t left_pwm = 0;               // [%]
  std::int8_t right_pwm = 0;              // [%]
  std::uint8_t charger = 0;               // 0: discharging
  std::uint8_t battery = 0;               // [0.1 V]
  std::array<std::uint16_t, 3> bottom{};  // cliff sensors right, centre, left: raw ADC; low means no floor
  std::array<std::uint8_t, 2> current{};  // left, right motor [10 mA]
  std::uint8_t over_current = 0;          // bit 0: left wheel, bit 1: right wheel
  std::uint16_t digital_input = 0;
  std::array<std::uint16_t, 4> analog_input{};
  std::int16_t angle = 0;       // [0.01 deg] gyro heading, wraps at +-180 deg
  std::int16_t angle_rate = 0;  // [0.01 deg/s]
  /// Rates [rad/s] about z of the raw gyro since the last packet, oldest first, one every world step.
  std::vector<double> raw_rates;
};

/// The bumper that a touch at `bearing` [rad] from the robot's x axis presses: left +30..+90, centre
/// -30..+30, right -30..-90 degrees; any equivalent angle will do; nothing behind.
[[nodiscard]] std::optional<std::uint8_t> bumperBit(double bearing);

}  // namespace kobuki_sim
