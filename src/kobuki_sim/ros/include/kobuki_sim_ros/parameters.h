// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "kobuki_sim/depth_camera_params.h"
#include "kobuki_sim/kobuki_params.h"
#include "kobuki_sim/lidar_params.h"
#include "kobuki_sim_ros/lockstep_gate.h"

namespace kobuki_sim {

/// Parameters of the simulation node in its private namespace, beside base/* (KobukiParams), camera/*
/// (DepthCameraParams) and lidar/* (LidarParams).
struct NodeParams {
  std::string scenario;           // path of the scenario file; must be given
  int seed = -1;                  // >= 0; -1: the scenario's own
  double rate = 1.0;              // [1] simulated per wall second; 0: as fast as the subscribers keep up
  bool start_paused = false;      // waits for kobuki_sim/pause or kobuki_sim/step
  double lockstep_slack = 0.06;   // [s] the world may be ahead of the slowest participant; only at rate 0
  double lockstep_timeout = 5.0;  // [s] wall time without an acknowledgement until a participant is given up

  double camera_frequency = 30.0;  // [Hz]
  double lidar_frequency = 0.0;    // [Hz] of /scan from a lidar; 0: the robot has none
  double people_frequency = 20.0;  // [Hz]

  // As the driver of a Kobuki (kobuki_node's base.yaml) has them.
  bool publish_tf = true;       // odom -> base_footprint
  bool use_imu_heading = true;  // heading of the odometry from the gyro
  std::string odom_frame = "odom";
  std::string base_frame = "base_footprint";
  std::string wheel_left_joint_name = "wheel_left_joint";
  std::string wheel_right_joint_name = "wheel_right_joint";
  double battery_capacity = 16.5;   // [V] of a full battery
  double battery_low = 14.0;        // [V]
  double battery_dangerous = 13.2;  // [V]

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("scenario", p.scenario);
    v("seed", p.seed, {-1.0, 2147483647.0});
    v("rate", p.rate, {0.0, 1000.0});
    v("start_paused", p.start_paused);
    v("lockstep_slack", p.lockstep_slack, {0.01, 10.0});
    v("lockstep_timeout", p.lockstep_timeout, {0.01, 3600.0});
    v("camera_frequency", p.camera_frequency, {0.1, 100.0});
    v("lidar_frequency", p.lidar_frequency, {0.0, 100.0});
    v("people_frequency", p.people_frequency, {0.1, 100.0});
    v("publish_tf", p.publish_tf);
    v("use_imu_heading", p.use_imu_heading);
    v("odom_frame", p.odom_frame);
    v("base_frame", p.base_frame);
    v("wheel_left_joint_name", p.wheel_left_joint_name);
    v("wheel_right_joint_name", p.wheel_right_joint_name);
    v("battery_capacity", p.battery_capacity, {0.1, 100.0});
    v("battery_low", p.battery_low, {0.0, 100.0});
    v("battery_dangerous", p.battery_dangerous, {0.0, 100.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Everything the node reads from the parameter server.
struct Parameters {
  NodeParams node;
  KobukiParams base;
  DepthCameraParams camera;
  LidarParams lidar;
  std::vector<LockstepParticipant> lockstep;  // names below lockstep/
};

/// A participant written NAME or NAME@SLACK, the latter for who hears of the world less often than the
/// others: "people_tracker@0.16". Throws sarn::ParameterError.
[[nodiscard]] LockstepParticipant parseParticipant(const std::string& text, double default_slack);

/// Reads the private namespace. Throws sarn::ParameterError.
[[nodiscard]] Parameters readParameters(const ros::NodeHandle& private_nh);

}  // namespace kobuki_sim
