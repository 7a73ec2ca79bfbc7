// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn_navigation {

enum class RobotFeedback { kNone = 0, kOdometry = 1, kEndCommands = 2 };

/// The names of yocs_velocity_smoother; the defaults of the TurtleBot.
struct VelocitySmootherParams {
  double speed_lim_v = 0.8;   // [m/s]
  double speed_lim_w = 5.4;   // [rad/s]
  double accel_lim_v = 1.0;   // [m/s^2]
  double accel_lim_w = 2.0;   // [rad/s^2]
  double frequency = 20.0;    // [1/s]
  double decel_factor = 1.5;  // deceleration limit = decel_factor * acceleration limit
  int robot_feedback = 2;     // 0 none, 1 odometry, 2 end commands (what the base was told last)

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("speed_lim_v", p.speed_lim_v, {0.01, 5.0});
    v("speed_lim_w", p.speed_lim_w, {0.01, 20.0});
    v("accel_lim_v", p.accel_lim_v, {0.01, 20.0});
    v("accel_lim_w", p.accel_lim_w, {0.01, 50.0});
    v("frequency", p.frequency, {1.0, 200.0});
    v("decel_factor", p.decel_factor, {0.1, 10.0});
    v("robot_feedback", p.robot_feedback, {0.0, 2.0});
  }
};

/// Largest change of a speed `from` towards `to` within `dt` [s]: `decel` while the magnitude falls, `accel`
/// while it grows, and the exact mixture when the speed passes zero on the way.
[[nodiscard]] double reachableChange(double from, double to, double accel, double decel, double dt);

/// Bounds velocity and acceleration of a command stream.
///
/// Each period the command moves from the last output towards the clamped input. The increments of v and
/// omega are scaled by one common factor, so that the command moves on a straight line in (v, omega). Silence
/// of the input longer than min(3 * median input period, 0.5 s) makes the target zero. When the feedback lies
/// further from the last output than two periods of acceleration (or deceleration, the larger), or the input
/// paused for five periods, the ramp restarts from the feedback: somebody else (the teleoperation, a bump)
/// has moved the robot in the meantime.
class VelocitySmoother {
 public:
  explicit VelocitySmoother(const VelocitySmootherParams& params);

  /// Both finite; times in [s] on one clock. A clock that jumps back is treated as a fresh start.
  void setInput(const sarn::Twist2D& input, double now);
  void setFeedback(const sarn::Twist2D& feedback, double now);

  /// The command of this period, to be called at params.frequency; nothing when there is nothing to say: no
  /// input and the last command was zero.
  [[nodiscard]] std::optional<sarn::Twist2D> update(double now);

  /// [s] of silence after which the input counts as gone.
  [[nodiscard]] double inputTimeout() const;
  /// Forgets everything.
  void reset();

 private:
  [[nodiscard]] std::optional<sarn::Twist2D> usableFeedback(double now) const;
  [[nodiscard]] bool deviates(const sarn::Twist2D& feedback) const;
  void resetOnClockJump(double now);
  [[nodiscard]] double medianPeriod() const;
  [[nodiscard]] sarn::Twist2D step(const sarn::Twist2D& from) const;

  VelocitySmootherParams params_;
  sarn::Twist2D target_;
  sarn::Twist2D last_output_;
  std::optional<sarn::Twist2D> feedback_;
  double feedback_time_ = 0.0;  // [s]
  double input_time_ = 0.0;     // [s]
  double latest_time_ = 0.0;    // [s]
  bool input_active_ = false;
  bool input_resumed_ =
      false;  // a command arrived after a pause; the next period may restart from the feedback
  std::deque<double> periods_;  // [s] between recent inputs
};

}  // namespace sarn_navigation
