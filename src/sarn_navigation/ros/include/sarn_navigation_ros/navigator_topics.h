// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Every topic, service and frame name of the navigator. Relative names resolve in the node's namespace,
// ~names in its own: the launch files name the node move_base, so that clients of move_base find what they
// know.
namespace sarn_navigation::topics {

// Inputs.
inline constexpr char kMap[] = "map";
inline constexpr char kOdometry[] = "odom";
inline constexpr char kScan[] = "scan";
inline constexpr char kPeople[] = "people";
inline constexpr char kPeoplePrediction[] = "people_prediction";
inline constexpr char kSimpleGoal[] = "move_base_simple/goal";
inline constexpr char kAction[] = "move_base";

// Outputs.
inline constexpr char kCommand[] = "cmd_vel";
inline constexpr char kStatus[] = "navigation_status";
inline constexpr char kLockstep[] = "lockstep/navigator";
inline constexpr char kPath[] = "plan";                 // ~
inline constexpr char kTrajectory[] = "trajectory";     // ~
inline constexpr char kCurrentGoal[] = "current_goal";  // ~

// Services.
inline constexpr char kMakePlan[] = "make_plan";            // ~
inline constexpr char kClearCostmaps[] = "clear_costmaps";  // ~

}  // namespace sarn_navigation::topics
