// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/velocity_smoother.h"

#include <algorithm>
#include <cmath>

namespace sarn_navigation {
namespace {

constexpr std::size_t kPeriodRecords = 5;
constexpr double kDefaultPeriod = 0.1;    // [s] of the input, until kPeriodRecords are known
constexpr double kMaxInputTimeout = 0.5;  // [s]
constexpr double kTimeoutPeriods = 3.0;   // input periods of silence that end the input
constexpr double kResumePeriods =
    5.0;  // input periods of silence after which the ramp restarts from the feedback
constexpr double kDeviationPeriods = 2.0;   // own periods of acceleration that feedback may lie apart
constexpr double kEndCommandTimeout = 0.6;  // [s] the Kobuki stops when it hears nothing for so long

bool isZero(const sarn::Twist2D& twist) { return twist.v == 0.0 && twist.omega == 0.0; }

}  // namespace

double reachableChange(double from, double to, double accel, double decel, double dt) {
  const double change = to - from;
  if (change == 0.0) return 0.0;
  double limit = accel * dt;
  if (from * change < 0.0) {
    const double time_to_zero = std::abs(from) / decel;
    limit = time_to_zero >= dt ? decel * dt : std::abs(from) + accel * (dt - time_to_zero);
  }
  return std::copysign(std::min(std::abs(change), limit), change);
}

VelocitySmoother::VelocitySmoother(const VelocitySmootherParams& params) : params_(params) {}

void VelocitySmoother::reset() { *this = VelocitySmoother(params_); }

void VelocitySmoother::resetOnClockJump(double now) {
  if (now < latest_time_) reset();
  latest_time_ = now;
}

void VelocitySmoother::setInput(const sarn::Twist2D& input, double now) {
  resetOnClockJump(now);
  target_ = {std::clamp(input.v, -params_.speed_lim_v, params_.speed_lim_v),
             std::clamp(input.omega, -params_.speed_lim_w, params_.speed_lim_w)};
  const double period = now - input_time_;
  input_resumed_ = input_resumed_ || !input_active_ || period > kResumePeriods * medianPeriod();
  if (input_active_) {
    periods_.push_back(period);
    if (periods_.size() > kPeriodRecords) periods_.pop_front();
  }
  input_time_ = now;
  input_active_ = true;
}

void VelocitySmoother::setFeedback(const sarn::Twist2D& feedback, double now) {
  resetOnClockJump(now);
  feedback_ = feedback;
  feedback_time_ = now;
}

double VelocitySmoother::medianPeriod() const {
  if (periods_.size() < kPeriodRecords) return kDefaultPeriod;
  std::vector<double> sorted(periods_.begin(), periods_.end());
  std::nth_element(sorted.begin(), sorted.begin() + kPeriodRecords / 2, sorted.end());
  return sorted[kPeriodRecords / 2];
}

double VelocitySmoother::inputTimeout() const {
  return std::min(kTimeoutPeriods * medianPeriod(), kMaxInputTimeout);
}

std::optional<sarn::Twist2D> VelocitySmoother::usableFeedback(double now) const {
  const auto source = static_cast<RobotFeedback>(params_.robot_feedback);
  if (source == RobotFeedback::kNone || !feedback_) return std::nullopt;
  if (now - feedback_time_ <= kEndCommandTimeout) return feedback_;
  // Old odometry says nothing; after old commands the base has stopped by itself.
  return source == RobotFeedback::kEndCommands ? std::optional<sarn::Twist2D>(sarn::Twist2D{}) : std::nullopt;
}

bool VelocitySmoother::deviates(const sarn::Twist2D& feedback) const {
  const double allowed = kDeviationPeriods * std::max(1.0, params_.decel_factor) / params_.frequency;
  return std::abs(feedback.v - last_output_.v) > allowed * params_.accel_lim_v ||
         std::abs(feedback.omega - last_output_.omega) > allowed * params_.accel_lim_w;
}

sarn::Twist2D VelocitySmoother::step(const sarn::Twist2D& from) const {
  const double dt = 1.0 / params_.frequency;
  const double wanted_v = target_.v - from.v;
  const double wanted_omega = target_.omega - from.omega;
  const double change_v =
      reachableChange(from.v, target_.v, params_.accel_lim_v, params_.decel_factor * params_.accel_lim_v, dt);
  const double change_omega = reachableChange(from.omega, target_.omega, params_.accel_lim_w,
                                              params_.decel_factor * params_.accel_lim_w, dt);
  double scale = 1.0;
  if (wanted_v != 0.0) scale = std::min(scale, change_v / wanted_v);
  if (wanted_omega != 0.0) scale = std::min(scale, change_omega / wanted_omega);
  if (scale >= 1.0) return target_;
  return {from.v + scale * wanted_v, from.omega + scale * wanted_omega};
}

std::optional<sarn::Twist2D> VelocitySmoother::update(double now) {
  resetOnClockJump(now);
  if (input_active_ && now - input_time_ > inputTimeout()) {
    input_active_ = false;
    target_ = {};
    periods_.clear();
  }
  if (!input_active_ && isZero(last_output_)) return std::nullopt;
  const auto feedback = usableFeedback(now);
  if (input_active_ && feedback && (input_resumed_ || deviates(*feedback))) last_output_ = *feedback;
  input_resumed_ = false;
  last_output_ = step(last_output_);
  return last_output_;
}

}  // namespace sarn_navigation
