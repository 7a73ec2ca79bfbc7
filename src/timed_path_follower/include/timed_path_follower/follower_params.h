// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace timed_path_follower {

struct FollowerParams {
  // Limits. A little above the planner's speeds, so that the robot can catch up; accelerations equal to the
  // planner's.
  double min_vel_x = 0.0;        // [m/s] <= 0; below 0 the robot may reverse
  double max_vel_x = 0.6;        // [m/s]
  double max_vel_theta = 1.3;    // [rad/s]
  double acc_lim_x = 1.0;        // [m/s^2]
  double acc_lim_theta = 2.0;    // [rad/s^2]
  double control_period = 0.05;  // [s] between calls, used when the time since the last call is unknown

  // Feedback law: see tracking_law.h. Stable for any positive gains.
  double gain_along = 1.0;    // [1/s] k_x of the longitudinal error
  double gain_across = 10.0;  // [1/m^2] k_y of the lateral error
  double gain_heading = 5.0;  // [1/m] k_theta of the heading error; near 2 sqrt(k_y): critically damped
  double gain_turning = 1.5;  // [1/s] k_t of the heading error at any speed
  double look_ahead = 0.1;    // [s] delay between command and motion that is led by

  // Errors, from the reference pose to the robot.
  double max_position_error = 0.35;  // [m] more: kDeviated
  double max_heading_error = 0.8;    // [rad] more: kDeviated
  double slow_down_error = 0.15;  // [m] lateral; more reduces the feed-forward, to none at max_position_error

  // Goal.
  double xy_goal_tolerance =
      0.18;  // [m] a little above the planner's, whose plans may end at the edge of theirs
  double yaw_goal_tolerance = 0.25;  // [rad]
  double stopped_vel_x = 0.05;       // [m/s] slower counts as standing
  double stopped_vel_theta = 0.1;    // [rad/s]
  double goal_patience = 2.0;  // [s] after the trajectory's end to settle at its last pose before kExpired

  // Obstacle hook.
  double obstacle_horizon = 1.0;  // [s] of motion that must be free
  double obstacle_step = 0.1;     // [s] between checked poses

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("min_vel_x", p.min_vel_x, {-2.0, 0.0});
    v("max_vel_x", p.max_vel_x, {0.01, 5.0});
    v("max_vel_theta", p.max_vel_theta, {0.01, 10.0});
    v("acc_lim_x", p.acc_lim_x, {0.01, 10.0});
    v("acc_lim_theta", p.acc_lim_theta, {0.01, 50.0});
    v("control_period", p.control_period, {0.001, 1.0});
    v("gain_along", p.gain_along, {0.01, 10.0});
    v("gain_across", p.gain_across, {0.01, 200.0});
    v("gain_heading", p.gain_heading, {0.01, 50.0});
    v("gain_turning", p.gain_turning, {0.0, 10.0});
    v("look_ahead", p.look_ahead, {0.0, 1.0});
    v("max_position_error", p.max_position_error, {0.02, 5.0});
    v("max_heading_error", p.max_heading_error, {0.05, 3.2});
    v("slow_down_error", p.slow_down_error, {0.0, 5.0});
    v("xy_goal_tolerance", p.xy_goal_tolerance, {0.01, 2.0});
    v("yaw_goal_tolerance", p.yaw_goal_tolerance, {0.01, 3.15});
    v("stopped_vel_x", p.stopped_vel_x, {0.001, 1.0});
    v("stopped_vel_theta", p.stopped_vel_theta, {0.001, 2.0});
    v("goal_patience", p.goal_patience, {0.0, 60.0});
    v("obstacle_horizon", p.obstacle_horizon, {0.0, 10.0});
    v("obstacle_step", p.obstacle_step, {0.01, 1.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace timed_path_follower
