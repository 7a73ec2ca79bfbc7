// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Every topic, service and frame name of the node, as on a TurtleBot2. Relative names: the node is started in
// the root namespace.
namespace kobuki_sim {

// Base, in.
inline constexpr char kVelocityTopic[] = "mobile_base/commands/velocity";
inline constexpr char kMotorPowerTopic[] = "mobile_base/commands/motor_power";
inline constexpr char kResetOdometryTopic[] = "mobile_base/commands/reset_odometry";
inline constexpr char kLed1Topic[] = "mobile_base/commands/led1";
inline constexpr char kLed2Topic[] = "mobile_base/commands/led2";
inline constexpr char kSoundTopic[] = "mobile_base/commands/sound";
inline constexpr char kDigitalOutputTopic[] = "mobile_base/commands/digital_output";
inline constexpr char kExternalPowerTopic[] = "mobile_base/commands/external_power";
inline constexpr char kControllerInfoCommandTopic[] = "mobile_base/commands/controller_info";

// Base, out.
inline constexpr char kOdometryTopic[] = "odom";
inline constexpr char kJointStatesTopic[] = "joint_states";
inline constexpr char kCoreTopic[] = "mobile_base/sensors/core";
inline constexpr char kDockIrTopic[] = "mobile_base/sensors/dock_ir";
inline constexpr char kImuTopic[] = "mobile_base/sensors/imu_data";
inline constexpr char kRawImuTopic[] = "mobile_base/sensors/imu_data_raw";
inline constexpr char kBumperCloudTopic[] = "mobile_base/sensors/bumper_pointcloud";
inline constexpr char kButtonTopic[] = "mobile_base/events/button";
inline constexpr char kBumperTopic[] = "mobile_base/events/bumper";
inline constexpr char kCliffTopic[] = "mobile_base/events/cliff";
inline constexpr char kWheelDropTopic[] = "mobile_base/events/wheel_drop";
inline constexpr char kPowerSystemTopic[] = "mobile_base/events/power_system";
inline constexpr char kDigitalInputTopic[] = "mobile_base/events/digital_input";
inline constexpr char kRobotStateTopic[] = "mobile_base/events/robot_state";
inline constexpr char kVersionInfoTopic[] = "mobile_base/version_info";
inline constexpr char kControllerInfoTopic[] = "mobile_base/controller_info";
inline constexpr char kDiagnosticsTopic[] = "diagnostics";

// Camera.
inline constexpr char kDepthImageTopic[] = "camera/depth/image_raw";
inline constexpr char kCameraInfoTopic[] = "camera/depth/camera_info";

// Lidar, where there is one.
inline constexpr char kScanTopic[] = "scan";

// World.
inline constexpr char kClockTopic[] = "clock";
inline constexpr char kTruthOdometryTopic[] = "ground_truth/odom";
inline constexpr char kTruthPeopleTopic[] = "ground_truth/people";
inline constexpr char kTruthContactsTopic[] = "ground_truth/contacts";
inline constexpr char kLockstepPrefix[] = "lockstep/";  // + name of the participant
inline constexpr char kResetService[] = "kobuki_sim/reset";
inline constexpr char kPauseService[] = "kobuki_sim/pause";
inline constexpr char kStepService[] = "kobuki_sim/step";
inline constexpr char kInjectService[] = "kobuki_sim/inject";

// Frames.
inline constexpr char kMapFrame[] = "map";
inline constexpr char kBaseLinkFrame[] = "base_link";
inline constexpr char kGyroFrame[] = "gyro_link";
inline constexpr char kDockIrFrame[] = "dock_ir_link";
inline constexpr char kDepthOpticalFrame[] = "camera_depth_optical_frame";
inline constexpr char kLidarFrame[] = "base_laser_link";

}  // namespace kobuki_sim
