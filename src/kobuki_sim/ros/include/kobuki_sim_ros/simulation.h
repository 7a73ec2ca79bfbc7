// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include <cstdint>
#include <string>

#include "kobuki_sim/world.h"
#include "kobuki_sim_ros/base_commands.h"
#include "kobuki_sim_ros/base_publisher.h"
#include "kobuki_sim_ros/camera_publisher.h"
#include "kobuki_sim_ros/ground_truth_publisher.h"
#include "kobuki_sim_ros/lidar_publisher.h"
#include "kobuki_sim_ros/parameters.h"

namespace kobuki_sim {

/// The world with its topics: takes commands, advances in steps and publishes what is due. The clock runs
/// forward through resets.
class Simulation {
 public:
  /// Throws what World throws.
  Simulation(ros::NodeHandle& nh, const Parameters& params, const Scenario& scenario, std::uint64_t seed);

  /// One world step, and everything that is due after it.
  void step();
  /// A new episode of the same scenario.
  void reset(std::uint64_t seed);
  /// Begins or ends an event; returns one line that says what is wrong with it, empty when nothing is.
  std::string inject(const std::string& event, bool active);

  void publishClock();
  [[nodiscard]] ros::Time now() const { return timeAt(steps_); }
  [[nodiscard]] ros::Time next() const { return timeAt(steps_ + 1); }
  [[nodiscard]] const World& world() const { return world_; }

 private:
  [[nodiscard]] ros::Time timeAt(std::uint64_t steps) const;

  Parameters params_;
  World world_;
  std::uint64_t step_length_;  // [ns]
  std::uint64_t steps_ = 0;    // since the node started
  ros::Publisher clock_;
  BaseCommands commands_;
  BasePublisher base_publisher_;
  CameraPublisher camera_publisher_;
  LidarPublisher lidar_publisher_;
  GroundTruthPublisher truth_publisher_;
};

}  // namespace kobuki_sim
