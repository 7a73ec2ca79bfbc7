// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>

#include "kobuki_sim/kobuki_base.h"
#include "kobuki_sim_ros/base_events.h"
#include "kobuki_sim_ros/parameters.h"
#include "kobuki_sim_ros/rate_divider.h"

namespace kobuki_sim {

/// What the driver of a Kobuki publishes: odometry, tf, joint states and events always; the sensor streams
/// only while somebody listens.
class BasePublisher {
 public:
  /// `raw_gyro_period` [s]: time between raw samples of the gyro.
  BasePublisher(ros::NodeHandle& nh, const NodeParams& params, double raw_gyro_period);

  /// Publishes the base's newest packet, if it is new; returns whether it was. `stamp`: time of receipt.
  bool publish(const KobukiBase& base, const ros::Time& stamp);
  /// Diagnostics, at 1 Hz; call it at every step.
  void publishDiagnostics(const KobukiBase& base, const ros::Time& stamp);
  /// The base starts anew: its packets count from zero.
  void restart() { packet_count_ = 0; }

 private:
  void publishOdometry(const DriverOdometry& odometry, const ros::Time& stamp);
  void publishStreams(const KobukiBase& base, const ros::Time& stamp);
  void publishBumperCloud(const SensorPacket& packet, const ros::Time& stamp);
  void publishEvents(const SensorPacket& packet);

  NodeParams params_;
  double raw_gyro_period_;
  std::uint64_t packet_count_ = 0;
  SensorPacket last_packet_;
  bool has_last_packet_ = false;
  bool cloud_active_ = false;
  RateDivider diagnostics_rate_{1.0};
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher odometry_, joint_states_;
  ros::Publisher core_, dock_ir_, imu_, raw_imu_, bumper_cloud_;
  ros::Publisher button_, bumper_, cliff_, wheel_drop_, power_system_, digital_input_;
  ros::Publisher robot_state_, version_info_, diagnostics_;
};

}  // namespace kobuki_sim
