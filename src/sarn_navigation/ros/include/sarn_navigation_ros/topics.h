// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Every topic name of the velocity chain. Relative names resolve in the node's namespace, ~names in the
// node's own.
namespace sarn_navigation::topics {

// cmd_vel_mux (inputs and output: config/mux.yaml, below the node's own name)
inline constexpr char kMuxActive[] = "active";

// velocity_smoother (below the node's own name, as yocs_velocity_smoother; the launch file remaps)
inline constexpr char kSmootherInput[] = "raw_cmd_vel";
inline constexpr char kSmootherOutput[] = "smooth_cmd_vel";
inline constexpr char kSmootherOdometry[] = "odometry";
inline constexpr char kSmootherEndCommands[] = "robot_cmd_vel";
inline constexpr char kSmootherLockstep[] = "/lockstep/velocity_smoother";

// safety_controller
inline constexpr char kBumperEvents[] = "mobile_base/events/bumper";
inline constexpr char kCliffEvents[] = "mobile_base/events/cliff";
inline constexpr char kWheelDropEvents[] = "mobile_base/events/wheel_drop";
inline constexpr char kSafetyOutput[] = "cmd_vel_mux/input/safety_controller";
inline constexpr char kSafetyEnable[] = "enable";    // ~
inline constexpr char kSafetyDisable[] = "disable";  // ~
inline constexpr char kSafetyReset[] = "reset";      // ~

// scan_brake
inline constexpr char kBrakeInput[] = "cmd_vel";
inline constexpr char kBrakeScan[] = "scan";
inline constexpr char kBrakeOutput[] = "navigation_velocity_smoother/raw_cmd_vel";
inline constexpr char kBrakeActive[] = "braking";  // ~

}  // namespace sarn_navigation::topics
