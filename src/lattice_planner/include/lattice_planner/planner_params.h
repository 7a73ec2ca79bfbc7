// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace lattice_planner {

/// Everything that decides what LatticePlanner searches and what it calls cheap. One unit of cost is what
/// time_weight makes of one second.
struct PlannerParams {
  // Lattice. Speeds are the multiples of acc_lim * time_step inside the limits.
  double time_step = 0.25;     // [s] duration of one action
  double min_vel_x = 0.0;      // [m/s] <= 0; below 0: the robot may reverse
  double max_vel_x = 0.5;      // [m/s]
  double acc_lim_x = 1.0;      // [m/s^2]
  double max_vel_theta = 1.0;  // [rad/s]
  double acc_lim_theta = 2.0;  // [rad/s^2]

  // Goal: inside both tolerances and standing still.
  double xy_goal_tolerance = 0.15;  // [m]
  double yaw_goal_tolerance = 0.2;  // [rad]

  // Cost C = sum w_i c_i.
  double time_weight = 1.0;       // [1/s]
  double length_weight = 0.2;     // [1/m]
  double rotation_weight = 0.1;   // [1/rad]
  double static_weight = 1.5;     // [1/s] for staying in static cost 252; smaller costs in proportion
  double social_weight = 8.0;     // [1/s] for staying in social cost 252; smaller costs in proportion
  bool combine_with_max = false;  // charge only the dearer of static and social cost, as the ancestor does
  // Charge as the ancestor does: the octile distance between an action's first and last cell as its length,
  // its start as one more sample of cost, people where they are when the action begins.
  bool charge_cells = false;

  // Where the time layers end: true: only people who stood still remain; false: all stay as the last layer
  // shows them.
  bool forget_moving_people = true;

  // What is forbidden.
  // The robot's outline in its base frame [m] as costmap_2d's footprint: a list of [x, y]. Empty: round, and
  // only its centre is looked at, on costs inflated by its radius.
  std::string footprint;
  int forbidden_cost = 253;                // cells of this cost or more, static or social, are forbidden
  bool allow_unknown = false;              // cells without information may be entered, at cost 126
  double collision_check_distance = 0.04;  // [m] between checked points of a motion, at full speed

  // Merging: two states of one merge cell are one to the search, the cheaper one stays, with its exact state.
  double merge_resolution = 0.1;  // [m]
  int heading_bins = 32;          // over the full circle, no seam
  int time_merge_steps = 2;       // [time steps] per merge cell, while people move

  // Search.
  double heuristic_weight = 1.3;     // >= 1; first solution by weighted A*, then the weight falls to 1
  double suboptimality_bound = 1.0;  // >= 1; stop as soon as cost <= bound * optimum is proved
  // Improve until this many times the first solution's work is done, and least_improvement; 0: no such limit.
  double improvement_effort = 0.5;
  int least_improvement = 200;  // [expansions]
  // Until so much is done in all, improve on where a guess promises a much cheaper plan; 0: nowhere.
  int promising_expansions = 0;
  int hurry_after = 3000;     // [expansions] without a plan until heuristic_weight rises; 0: never
  int max_expansions = 0;     // 0: only time limits; else a bound that gives the same answer on any machine
  int max_states = 1000000;   // memory bound: at most 150 bytes each
  double table_radius = 1.0;  // [m] of the obstacle-free cost table around the goal; 0: no table
  double table_resolution = 0.1;  // [m]
  int table_headings = 48;

  // Leaving a forbidden area that the robot finds itself in.
  double escape_radius = 1.0;  // [m] around the start within which the escape rule holds

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("time_step", p.time_step, {0.05, 2.0});
    v("min_vel_x", p.min_vel_x, {-2.0, 0.0});
    v("max_vel_x", p.max_vel_x, {0.01, 5.0});
    v("acc_lim_x", p.acc_lim_x, {0.01, 10.0});
    v("max_vel_theta", p.max_vel_theta, {0.01, 10.0});
    v("acc_lim_theta", p.acc_lim_theta, {0.01, 50.0});
    v("xy_goal_tolerance", p.xy_goal_tolerance, {0.01, 2.0});
    v("yaw_goal_tolerance", p.yaw_goal_tolerance, {0.01, 3.15});
    v("time_weight", p.time_weight, {1e-3, 1e6});
    v("length_weight", p.length_weight, {0.0, 1e6});
    v("rotation_weight", p.rotation_weight, {0.0, 1e6});
    v("static_weight", p.static_weight, {0.0, 1e6});
    v("social_weight", p.social_weight, {0.0, 1e6});
    v("combine_with_max", p.combine_with_max);
    v("charge_cells", p.charge_cells);
    v("forget_moving_people", p.forget_moving_people);
    v("footprint", p.footprint);
    v("forbidden_cost", p.forbidden_cost, {1.0, 254.0});
    v("allow_unknown", p.allow_unknown);
    v("collision_check_distance", p.collision_check_distance, {0.005, 0.5});
    v("merge_resolution", p.merge_resolution, {1e-3, 0.5});
    v("heading_bins", p.heading_bins, {4.0, 1024.0});
    v("time_merge_steps", p.time_merge_steps, {1.0, 100.0});
    v("heuristic_weight", p.heuristic_weight, {1.0, 100.0});
    v("suboptimality_bound", p.suboptimality_bound, {1.0, 100.0});
    v("improvement_effort", p.improvement_effort, {0.0, 1e6});
    v("least_improvement", p.least_improvement, {0.0, 1e9});
    v("promising_expansions", p.promising_expansions, {0.0, 1e9});
    v("hurry_after", p.hurry_after, {0.0, 1e9});
    v("max_expansions", p.max_expansions, {0.0, 2e9});
    v("max_states", p.max_states, {1000.0, 5e7});
    v("table_radius", p.table_radius, {0.0, 5.0});
    v("table_resolution", p.table_resolution, {0.02, 0.5});
    v("table_headings", p.table_headings, {8.0, 360.0});
    v("escape_radius", p.escape_radius, {0.0, 5.0});
  }
  /// Limits that are not multiples of one acceleration step, too many speeds.
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace lattice_planner
