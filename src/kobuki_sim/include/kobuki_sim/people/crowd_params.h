// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kobuki_sim/people/orca.h"
#include "kobuki_sim/people/social_force.h"

namespace kobuki_sim {

/// How the people of a crowd behave, beyond what a scenario says of each.
struct CrowdParams {
  double decision_period = 0.1;        // [s] > 0, between two decisions of people who react
  OrcaParams orca{5.0, 10, 3.0, 1.0};  // of people of the model orca
  double comfort_gap = 0.1;  // [m] free between bodies that people of the model orca keep where they can
  SocialForceParams social_force;     // of people of the model social_force
  double max_speed_factor = 1.3;      // >= 1, fastest walk as a multiple of the preferred speed
  double standing_robot_speed = 0.1;  // [m/s] below, people expect no avoidance from the robot
  double pass_right_angle = 0.03;     // [rad] preferred directions lean to the right: people agree on a side
  double direction_noise = 0.05;      // [rad] half width of the draw that breaks symmetric stand-offs
  double waypoint_tolerance = 0.3;    // [m] > 0, a waypoint on the way counts as reached
  double stop_tolerance = 0.1;        // [m] > 0, the last waypoint counts as reached
  double blocked_speed = 0.15;        // [1] progress below this part of the preferred speed counts as blocked
  double patience = 2.0;              // [s] blocked for so long (up to twice, drawn), somebody steps aside
  double yield_time = 1.5;            // [s] stepping aside takes so long (up to twice, drawn)
  double separation_speed = 0.4;      // [m/s] at which people who overlap are pushed apart at most
};

}  // namespace kobuki_sim
