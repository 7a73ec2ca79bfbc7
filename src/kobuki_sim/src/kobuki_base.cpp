// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/kobuki_base.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kobuki_sim/base_command.h"

namespace kobuki_sim {
namespace {

constexpr std::uint16_t kFloorReading = 1500;  // raw ADC of a cliff sensor above the floor
constexpr std::uint16_t kNoFloorReading = 50;  // and beyond an edge

const KobukiParams& validated(const KobukiParams& params) {
  const auto found = sarn::problems(params);
  if (!found.empty()) throw std::invalid_argument("Kobuki parameter " + found.front());
  return params;
}

double validatedTimeStep(double time_step) {
  if (!(time_step > 0.0) || !std::isfinite(time_step)) {
    throw std::invalid_argument("time step " + std::to_string(time_step) + " s is not above zero");
  }
  return time_step;
}

/// Steps in a period [s], at least one.
std::uint64_t stepsIn(double period, double time_step) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(period / time_step)));
}

template <class Integer>
Integer limited(double value) {
  return static_cast<Integer>(std::clamp(std::round(value),
                                         static_cast<double>(std::numeric_limits<Integer>::min()),
                                         static_cast<double>(std::numeric_limits<Integer>::max())));
}

/// Encoder reading after a way [m]: whole ticks, the lowest 16 bits.
std::uint16_t encoderReading(double travel, double ticks_per_metre) {
  return static_cast<std::uint16_t>(static_cast<std::int64_t>(std::floor(travel * ticks_per_metre)));
}

/// An angle or rate [rad, rad/s] in hundredths of degrees.
std::int16_t centidegrees(double value) { return limited<std::int16_t>(value * 18000.0 / sarn::kPi); }

double approached(double speed, double target, double acceleration, double deceleration, double dt) {
  const bool slows = speed * (target - speed) < 0.0;
  const double most = (slows ? deceleration : acceleration) * dt;
  return speed + std::clamp(target - speed, -most, most);
}

}  // namespace

KobukiBase::KobukiBase(const KobukiParams& params, double time_step, std::uint64_t seed)
    : params_(validated(params)),
      time_step_(validatedTimeStep(time_step)),
      steps_per_packet_(stepsIn(1.0 / params.sensor_frequency, time_step)),
      steps_per_watchdog_(stepsIn(1.0 / params.watchdog_frequency, time_step)),
      delay_steps_(static_cast<std::uint64_t>(std::round(params.command_delay / time_step))),
      wheel_noise_(seed, "wheels"),
      gyro_({params.gyro_noise, params.gyro_bias_sigma, params.gyro_bias_walk, params.gyro_scale_sigma},
            seed),
      odometry_(params.wheel_separation, params.wheel_radius, params.ticks_per_metre),
      charge_(params.battery_charge) {
  for (double& scale : wheel_scale_) scale = 1.0 + params.wheel_scale_sigma * wheel_noise_.normal();
  drainBattery();
}

bool KobukiBase::commandVelocity(double v, double omega) {
  const bool finite = std::isfinite(v) && std::isfinite(omega);
  if (!motor_power_) return finite;
  command_ = finite ? sarn::Twist2D{v, omega} : sarn::Twist2D{};
  has_command_ = true;
  timed_out_ = false;
  last_command_time_ = time();
  return finite;
}

void KobukiBase::setMotorPower(bool on) {
  motor_power_ = on;
  if (on) {
    last_command_time_ = time();
    timed_out_ = false;
  } else {
    command_ = {};
  }
}

void KobukiBase::setBatteryCharge(double charge) {
  charge_ = std::clamp(charge, 0.0, 1.0);
  drainBattery();
}

void KobukiBase::checkTimeout() {
  constexpr double kRounding = 1e-9;  // [s]
  if (!motor_power_ || !has_command_ || timed_out_) return;
  if (time() - last_command_time_ <= params_.cmd_vel_timeout + kRounding) return;
  timed_out_ = true;
  if (command_.v != 0.0 || command_.omega != 0.0) ++timeout_count_;  // who was told to stand stands anyway
  command_ = {};
}

void KobukiBase::sendCommand() {
  if (command_.v == sent_.v && command_.omega == sent_.omega) return;
  sent_ = command_;
  const double b = params_.wheel_separation;
  const sarn::Twist2D received =
      params_.quantise_commands ? decodeCommand(encodeCommand(sent_, b), b) : sent_;
  pending_.push_back({steps_ + delay_steps_, received});
}

void KobukiBase::turnWheels() {
  // Too fast a command is slowed down on its own curve.
  const double too_fast = std::max({1.0, std::abs(target_.v) / std::max(params_.max_vel_x, 1e-12),
                                    std::abs(target_.omega) / std::max(params_.max_vel_theta, 1e-12)});
  const double v = target_.v / too_fast;
  const double half_turn = 0.5 * params_.wheel_separation * target_.omega / too_fast;
  const std::array<double, 2> goal = {v - half_turn, v + half_turn};
  std::array<double, 2> floor_speed{};
  for (const std::size_t i : {0U, 1U}) {
    const double before = wheel_speed_[i];
    wheel_speed_[i] =
        approached(before, goal[i], params_.wheel_acceleration, params_.wheel_deceleration, time_step_);
    wheel_acceleration_[i] = (wheel_speed_[i] - before) / time_step_;
    wheel_step_[i] = 0.5 * (before + wheel_speed_[i]) * time_step_;
    floor_speed[i] = wheel_step_[i] * wheel_scale_[i] / time_step_;
    if (params_.wheel_slip_noise > 0.0 && wheel_step_[i] != 0.0) {
      const double slip =
          params_.wheel_slip_noise * std::sqrt(std::abs(wheel_step_[i])) * wheel_noise_.normal();
      floor_speed[i] += slip / time_step_;
    }
  }
  wanted_ = {0.5 * (floor_speed[0] + floor_speed[1]),
             (floor_speed[1] - floor_speed[0]) / params_.wheel_separation};
}

sarn::Twist2D KobukiBase::drive() {
  if (due(steps_per_watchdog_)) checkTimeout();
  if (due(steps_per_packet_)) sendCommand();
  while (!pending_.empty() && pending_.front().step <= steps_) {
    target_ = pending_.front().twist;
    pending_.pop_front();
  }
  turnWheels();
  return wanted_;
}

void KobukiBase::holdWheels(const sarn::Twist2D& actual) {
  const double half_turn = 0.5 * params_.wheel_separation * (actual.omega - wanted_.omega);
  const double lost_v = actual.v - wanted_.v;
  const std::array<double, 2> lost = {lost_v - half_turn, lost_v + half_turn};  // [m/s] on the floor
  for (const std::size_t i : {0U, 1U}) {
    const double missing = (1.0 - params_.blocked_wheel_slip) * lost[i] / wheel_scale_[i];
    wheel_step_[i] += missing * time_step_;
    wheel_speed_[i] = wheel_step_[i] / time_step_;
  }
}

void KobukiBase::measureCurrents(bool blocked) {
  for (const std::size_t i : {0U, 1U}) {
    const double speed = std::abs(wheel_speed_[i]);
    const bool pushes = blocked && (target_.v != 0.0 || target_.omega != 0.0);
    motor_current_[i] = (speed > 1e-4 ? params_.motor_friction_current : 0.0) +
                        params_.motor_speed_current * speed +
                        params_.motor_acceleration_current * std::abs(wheel_acceleration_[i]) +
                        (pushes ? params_.motor_blocked_current : 0.0);
  }
}

void KobukiBase::drainBattery() {
  const double current = params_.idle_current + motor_current_[0] + motor_current_[1];
  charge_ = std::max(0.0, charge_ - current * time_step_ / (3600.0 * params_.battery_capacity));
  battery_voltage_ = params_.battery_empty + (params_.battery_full - params_.battery_empty) * charge_ -
                     params_.battery_resistance * current;
}

void KobukiBase::settle(const sarn::Twist2D& actual, bool blocked, std::uint8_t bumper) {
  if (blocked) holdWheels(actual);
  for (const std::size_t i : {0U, 1U}) wheel_travel_[i] += wheel_step_[i];
  twist_ = actual;
  raw_rates_.push_back(gyro_.measure(actual.omega, time_step_));
  measureCurrents(blocked);
  drainBattery();
  ++steps_;
  if (due(steps_per_packet_)) makePacket(bumper);
}

void KobukiBase::makePacket(std::uint8_t bumper) {
  packet_.time = time();
  packet_.time_stamp = static_cast<std::uint16_t>(static_cast<std::uint64_t>(std::llround(time() * 1000.0)));
  packet_.bumper = bumper;
  packet_.wheel_drop = wheel_drop_;
  packet_.cliff = cliff_;
  packet_.buttons = buttons_;
  packet_.left_encoder = encoderReading(wheel_travel_[0], params_.ticks_per_metre);
  packet_.right_encoder = encoderReading(wheel_travel_[1], params_.ticks_per_metre);
  const double full_speed = std::max(params_.max_vel_x, 1e-12);
  packet_.left_pwm = limited<std::int8_t>(100.0 * wheel_speed_[0] / full_speed);
  packet_.right_pwm = limited<std::int8_t>(100.0 * wheel_speed_[1] / full_speed);
  packet_.battery = limited<std::uint8_t>(10.0 * battery_voltage_);
  packet_.bottom = {(cliff_ & kRightBit) != 0 ? kNoFloorReading : kFloorReading,
                    (cliff_ & kCentreBit) != 0 ? kNoFloorReading : kFloorReading,
                    (cliff_ & kLeftBit) != 0 ? kNoFloorReading : kFloorReading};
  packet_.over_current = 0;
  for (const std::size_t i : {0U, 1U}) {
    packet_.current[i] = limited<std::uint8_t>(100.0 * motor_current_[i]);
    if (motor_current_[i] > params_.over_current) {
      packet_.over_current = static_cast<std::uint8_t>(packet_.over_current | (1U << i));
    }
  }
  packet_.angle = centidegrees(gyro_.angle());
  packet_.angle_rate = centidegrees(gyro_.rate());
  packet_.raw_rates.swap(raw_rates_);
  raw_rates_.clear();
  ++packet_count_;
  odometry_.update(packet_, static_cast<double>(steps_per_packet_) * time_step_);
}

}  // namespace kobuki_sim
