// SPDX-License-Identifier: BSD-3-Clause
#include "timed_path_follower/timed_path_follower.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sarn_common/angles.h"
#include "timed_path_follower/tracking_law.h"

namespace timed_path_follower {
namespace {

constexpr double kLongestGap = 0.5;  // [s] a longer time between calls counts as a fresh start

const FollowerParams& checked(const FollowerParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("timed_path_follower: " + text);
  return params;
}

bool finite(const sarn::Pose2D& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.theta);
}
bool finite(const sarn::Twist2D& t) { return std::isfinite(t.v) && std::isfinite(t.omega); }

void checkTrajectory(const sarn::TimedTrajectory& trajectory) {
  double last = -HUGE_VAL;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const sarn::TrajectoryPoint& p = trajectory.points[i];
    const std::string where = "trajectory point " + std::to_string(i);
    if (!finite(p.pose()) || !std::isfinite(p.v) || !std::isfinite(p.omega) || !std::isfinite(p.t)) {
      throw std::invalid_argument(where + ": a value is not finite");
    }
    if (!(p.t > last)) throw std::invalid_argument(where + ": its time is not later than the one before");
    last = p.t;
  }
}

double approach(double from, double to, double step) { return std::clamp(to, from - step, from + step); }

}  // namespace

const char* toString(FollowStatus status) {
  switch (status) {
    case FollowStatus::kTracking:
      return "tracking";
    case FollowStatus::kGoalReached:
      return "goal reached";
    case FollowStatus::kDeviated:
      return "deviated";
    case FollowStatus::kExpired:
      return "expired";
    case FollowStatus::kNoTrajectory:
      return "no trajectory";
  }
  return "unknown";
}

TimedPathFollower::TimedPathFollower(const FollowerParams& params) : params_(checked(params)) {}

void TimedPathFollower::setTrajectory(sarn::TimedTrajectory trajectory, const sarn::Pose2D& goal) {
  trajectory_.points.clear();
  if (!finite(goal)) throw std::invalid_argument("goal: a value is not finite");
  checkTrajectory(trajectory);
  trajectory_ = std::move(trajectory);
  goal_ = goal;
}

void TimedPathFollower::clear() {
  trajectory_.points.clear();
  last_error_.reset();
}

FollowCommand TimedPathFollower::computeVelocity(const sarn::Pose2D& pose, const sarn::Twist2D& measured,
                                                 double now) {
  if (!finite(pose) || !finite(measured) || !std::isfinite(now)) {
    last_error_.reset();
    return stop(FollowStatus::kNoTrajectory, params_.control_period);
  }
  const bool fresh = !last_time_ || now < *last_time_ || now - *last_time_ > kLongestGap;
  if (fresh) last_command_ = measured;  // what the robot does now is where the acceleration limits start
  const double dt = fresh ? params_.control_period : now - *last_time_;
  last_time_ = now;
  if (trajectory_.empty()) {
    last_error_.reset();
    return stop(FollowStatus::kNoTrajectory, dt);
  }
  return follow(pose, measured, now, dt);
}

FollowCommand TimedPathFollower::follow(const sarn::Pose2D& pose, const sarn::Twist2D& measured, double now,
                                        double dt) {
  // What the errors of the present say about deviation.
  last_error_ = trackingError(pose, trajectory_.sample(now).pose());
  const double distance = std::hypot(last_error_->x, last_error_->y);
  const bool over = now >= trajectory_.endTime();
  if (over && atGoal(pose)) {
    FollowCommand command = stop(FollowStatus::kTracking, dt);
    const bool stopped = standing(measured) && command.twist.v == 0.0 && command.twist.omega == 0.0;
    command.status = stopped ? FollowStatus::kGoalReached : FollowStatus::kTracking;
    return command;
  }
  if (now > trajectory_.endTime() + params_.goal_patience) return stop(FollowStatus::kExpired, dt);
  if (distance > params_.max_position_error || std::abs(last_error_->theta) > params_.max_heading_error) {
    return stop(FollowStatus::kDeviated, dt);
  }
  // What the command, acting a little later, should do.
  const double then = now + params_.look_ahead;
  const sarn::TrajectoryPoint reference = trajectory_.sample(then);
  const bool moving = then >= trajectory_.startTime() && then < trajectory_.endTime();
  const sarn::Pose2D pose_then = sarn::advance(pose, last_command_, params_.look_ahead);
  const sarn::Pose2D error = trackingError(pose_then, reference.pose());
  const double span = params_.max_position_error - params_.slow_down_error;
  const double share = std::clamp((params_.max_position_error - std::abs(error.y)) / span, 0.0, 1.0);
  const sarn::Twist2D feed_forward =
      moving ? sarn::Twist2D{share * reference.v, share * reference.omega} : sarn::Twist2D{};
  const sarn::Twist2D wanted =
      trackingLaw(error, feed_forward,
                  {params_.gain_along, params_.gain_across, params_.gain_heading, params_.gain_turning});
  const sarn::Twist2D allowed = limit(wanted, dt);
  if (motionCollides(pose, allowed)) {
    FollowCommand command = stop(FollowStatus::kTracking, dt);
    command.blocked = true;
    return command;
  }
  return drive(allowed, dt);
}

FollowCommand TimedPathFollower::stop(FollowStatus status, double dt) {
  FollowCommand command = drive({0.0, 0.0}, dt);
  command.status = status;
  return command;
}

FollowCommand TimedPathFollower::drive(const sarn::Twist2D& wanted, double dt) {
  last_command_ = limit(wanted, dt);
  return {last_command_, FollowStatus::kTracking, false};
}

sarn::Twist2D TimedPathFollower::limit(const sarn::Twist2D& wanted, double dt) const {
  const double v = std::clamp(wanted.v, params_.min_vel_x, params_.max_vel_x);
  const double omega = std::clamp(wanted.omega, -params_.max_vel_theta, params_.max_vel_theta);
  return {approach(last_command_.v, v, params_.acc_lim_x * dt),
          approach(last_command_.omega, omega, params_.acc_lim_theta * dt)};
}

/// Asks the hook along the next second: the commanded arc for as long as the robot would need to stop, at
/// least one step, then the way of the reference itself.
bool TimedPathFollower::motionCollides(const sarn::Pose2D& pose, const sarn::Twist2D& twist) const {
  if (!collides_ || params_.obstacle_horizon <= 0.0) return false;
  if (std::abs(twist.v) < 1e-6) return false;  // a round robot that turns in place touches nothing new
  if (collides_(pose)) return false;           // already in: how to get out is the planner's matter
  const double stopping = std::abs(twist.v) / params_.acc_lim_x + params_.look_ahead;
  const double arc = std::min(std::max(stopping, params_.obstacle_step), params_.obstacle_horizon);
  for (double t = params_.obstacle_step; t < arc + params_.obstacle_step; t += params_.obstacle_step) {
    if (collides_(sarn::advance(pose, twist, std::min(t, arc)))) return true;
  }
  for (double t = arc; t <= params_.obstacle_horizon; t += params_.obstacle_step) {
    if (collides_(trajectory_.sample(*last_time_ + t).pose())) return true;
  }
  return false;
}

bool TimedPathFollower::atGoal(const sarn::Pose2D& pose) const {
  return std::hypot(pose.x - goal_.x, pose.y - goal_.y) <= params_.xy_goal_tolerance &&
         std::abs(sarn::angleDifference(pose.theta, goal_.theta)) <= params_.yaw_goal_tolerance;
}

bool TimedPathFollower::standing(const sarn::Twist2D& measured) const {
  return std::abs(measured.v) <= params_.stopped_vel_x &&
         std::abs(measured.omega) <= params_.stopped_vel_theta;
}

}  // namespace timed_path_follower
