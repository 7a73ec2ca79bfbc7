// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace kobuki_sim {

/// Numbers of the simulated base. What a sigma describes is drawn once from the seed and then stays, as on
/// one particular robot; noise is drawn anew all the time.
struct KobukiParams {
  // Geometry
  double wheel_separation = 0.23;        // [m]
  double wheel_radius = 0.035;           // [m]
  double ticks_per_metre = 11724.41658;  // [tick/m] encoder
  double hull_radius = 0.17575;          // [m] of the bumper ring: what touches walls and people

  // Drive
  double max_vel_x = 0.7;            // [m/s] faster commands are scaled down, on the same curve
  double max_vel_theta = 3.1415926;  // [rad/s]
  double wheel_acceleration = 2.0;   // [m/s^2] of each wheel when its speed grows
  double wheel_deceleration = 2.0;   // [m/s^2] of each wheel when its speed falls
  double command_delay = 0.04;       // [s] from the driver's cycle to the wheels
  bool quantise_commands = true;     // send int16 speed [mm/s] and radius [mm] as the driver does
  double cmd_vel_timeout = 0.6;      // [s] without a command, seen by the watchdog
  double watchdog_frequency = 10.0;  // [Hz]
  double sensor_frequency = 50.0;    // [Hz] driver cycle: packets in, commands out

  // Wheels on the floor
  double wheel_scale_sigma = 0.003;  // [1] of each wheel's error of travelled length
  double wheel_slip_noise = 0.002;   // [m/sqrt(m)] of each wheel, grows with the root of the length
  double blocked_wheel_slip = 0.5;   // [1] share of the lost motion that wheels turn when the robot is held

  // Gyro
  double gyro_noise = 5e-4;         // [rad/s/sqrt(Hz)] white
  double gyro_bias_sigma = 2e-4;    // [rad/s] of the bias at the start
  double gyro_bias_walk = 1e-5;     // [rad/s/sqrt(s)] of the bias
  double gyro_scale_sigma = 0.002;  // [1] of the error of measured turns

  // Power
  double battery_capacity = 4.4;             // [Ah]
  double battery_full = 16.5;                // [V] at rest
  double battery_empty = 13.2;               // [V] at rest
  double battery_resistance = 0.2;           // [Ohm]
  double battery_charge = 0.95;              // [1] at the start
  double idle_current = 0.4;                 // [A] electronics
  double motor_friction_current = 0.02;      // [A] of a turning wheel
  double motor_speed_current = 0.04;         // [A/(m/s)]
  double motor_acceleration_current = 0.01;  // [A/(m/s^2)]
  double motor_blocked_current = 0.4;        // [A] while something holds the robot and the wheels push
  double over_current = 1.0;                 // [A] of a motor: reported as too much

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("wheel_separation", p.wheel_separation, {0.01, 2.0});
    v("wheel_radius", p.wheel_radius, {0.005, 0.5});
    v("ticks_per_metre", p.ticks_per_metre, {1.0, 1e6});
    v("hull_radius", p.hull_radius, {0.01, 2.0});
    v("max_vel_x", p.max_vel_x, {0.0, 5.0});
    v("max_vel_theta", p.max_vel_theta, {0.0, 20.0});
    v("wheel_acceleration", p.wheel_acceleration, {0.01, 1000.0});
    v("wheel_deceleration", p.wheel_deceleration, {0.01, 1000.0});
    v("command_delay", p.command_delay, {0.0, 1.0});
    v("quantise_commands", p.quantise_commands);
    v("cmd_vel_timeout", p.cmd_vel_timeout, {0.0, 60.0});
    v("watchdog_frequency", p.watchdog_frequency, {0.1, 1000.0});
    v("sensor_frequency", p.sensor_frequency, {0.1, 1000.0});
    v("wheel_scale_sigma", p.wheel_scale_sigma, {0.0, 0.1});
    v("wheel_slip_noise", p.wheel_slip_noise, {0.0, 0.1});
    v("blocked_wheel_slip", p.blocked_wheel_slip, {0.0, 1.0});
    v("gyro_noise", p.gyro_noise, {0.0, 0.1});
    v("gyro_bias_sigma", p.gyro_bias_sigma, {0.0, 0.1});
    v("gyro_bias_walk", p.gyro_bias_walk, {0.0, 0.01});
    v("gyro_scale_sigma", p.gyro_scale_sigma, {0.0, 0.1});
    v("battery_capacity", p.battery_capacity, {0.01, 100.0});
    v("battery_full", p.battery_full, {1.0, 60.0});
    v("battery_empty", p.battery_empty, {0.0, 60.0});
    v("battery_resistance", p.battery_resistance, {0.0, 10.0});
    v("battery_charge", p.battery_charge, {0.0, 1.0});
    v("idle_current", p.idle_current, {0.0, 50.0});
    v("motor_friction_current", p.motor_friction_current, {0.0, 10.0});
    v("motor_speed_current", p.motor_speed_current, {0.0, 10.0});
    v("motor_acceleration_current", p.motor_acceleration_current, {0.0, 10.0});
    v("motor_blocked_current", p.motor_blocked_current, {0.0, 10.0});
    v("over_current", p.over_current, {0.0, 100.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
  /// The same base without any error, noise, delay or quantisation.
  [[nodiscard]] static KobukiParams ideal();
};

}  // namespace kobuki_sim
