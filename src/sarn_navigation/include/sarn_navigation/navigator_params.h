// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_navigation {

/// How the navigator plans, waits, yields and recovers. Names follow move_base where they mean the same.
struct NavigatorParams {
  double controller_frequency = 20.0;  // [Hz]
  double planner_frequency = 2.0;      // [Hz] re-planning while a goal is active
  double planning_timeout = 0.25;      // [s] wall time of one search
  double release_delay =
      0.35;  // [s] a new plan starts this long after its search began (>= planning_timeout)
  double keep_plan_ratio = 0.9;      // a new plan must cost less than this share of the one being driven
  double conflict_horizon = 4.0;     // [s] the plan is checked this far ahead against new costs
  double brake_margin = 0.4;         // [s] reaction time added to the braking time before a conflict
  double acc_lim_x = 1.0;            // [m/s^2] braking, the planner's
  double acc_lim_theta = 2.0;        // [rad/s^2] braking, the planner's
  double transform_tolerance = 0.5;  // [s] an older pose or scan makes the robot stand still
  double progress_distance = 0.3;    // [m] coming this much closer to the goal counts as progress
  double progress_timeout = 12.0;    // [s] without progress and without people near: recover
  double people_patience = 60.0;  // [s] without progress while people are near: wait this long, then recover
  double people_near_distance = 2.5;  // [m] people within it are a reason to wait
  int max_recoveries = 4;             // give the goal up after this many without progress between them
  double recovery_wait = 2.0;         // [s]
  double recovery_turn_speed = 0.8;   // [rad/s]
  bool yield_enabled = true;          // move aside for people whose way the robot blocks
  double yield_horizon = 5.0;         // [s] predicted paths are looked at this far
  double yield_distance =
      0.55;  // [m] a path that comes closer than this to the standing robot is blocked by it
  double yield_search_radius = 6.0;  // [m] how far aside the robot goes at most
  double yield_timeout = 20.0;       // [s] then it goes back to its goal

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("controller_frequency", p.controller_frequency, {1.0, 100.0});
    v("planner_frequency", p.planner_frequency, {0.1, 20.0});
    v("planning_timeout", p.planning_timeout, {0.01, 10.0});
    v("release_delay", p.release_delay, {0.0, 10.0});
    v("keep_plan_ratio", p.keep_plan_ratio, {0.0, 1.0});
    v("conflict_horizon", p.conflict_horizon, {0.0, 30.0});
    v("brake_margin", p.brake_margin, {0.0, 5.0});
    v("acc_lim_x", p.acc_lim_x, {0.05, 10.0});
    v("acc_lim_theta", p.acc_lim_theta, {0.05, 20.0});
    v("transform_tolerance", p.transform_tolerance, {0.05, 5.0});
    v("progress_distance", p.progress_distance, {0.05, 5.0});
    v("progress_timeout", p.progress_timeout, {1.0, 300.0});
    v("people_patience", p.people_patience, {1.0, 3600.0});
    v("people_near_distance", p.people_near_distance, {0.5, 20.0});
    v("max_recoveries", p.max_recoveries, {0.0, 100.0});
    v("recovery_wait", p.recovery_wait, {0.0, 60.0});
    v("recovery_turn_speed", p.recovery_turn_speed, {0.1, 3.0});
    v("yield_enabled", p.yield_enabled);
    v("yield_horizon", p.yield_horizon, {0.5, 20.0});
    v("yield_distance", p.yield_distance, {0.2, 2.0});
    v("yield_search_radius", p.yield_search_radius, {0.5, 20.0});
    v("yield_timeout", p.yield_timeout, {1.0, 300.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    if (release_delay >= planning_timeout) return {};
    return {"release_delay: must not be shorter than planning_timeout"};
  }
};

}  // namespace sarn_navigation
