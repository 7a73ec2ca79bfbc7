// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>
#include <optional>

#include "kobuki_sim/lidar.h"
#include "kobuki_sim/world.h"
#include "kobuki_sim_ros/parameters.h"
#include "kobuki_sim_ros/rate_divider.h"

namespace kobuki_sim {

/// A lidar's scans, on robots that have one (lidar_frequency above 0); measured only while somebody listens.
class LidarPublisher {
 public:
  LidarPublisher(ros::NodeHandle& nh, const Parameters& params, std::uint64_t seed);

  /// Call it at every step; publishes at the lidar's frequency.
  void publish(const World& world, const ros::Time& stamp);
  /// A new episode: noise from another seed.
  void restart(std::uint64_t seed);

 private:
  double frequency_;  // [Hz] 0: no lidar
  Lidar lidar_;
  std::optional<RateDivider> rate_;  // nothing: no lidar
  ros::Publisher scan_;
};

}  // namespace kobuki_sim
