// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>

#include "kobuki_sim/depth_camera.h"
#include "kobuki_sim/world.h"
#include "kobuki_sim_ros/parameters.h"
#include "kobuki_sim_ros/rate_divider.h"

namespace kobuki_sim {

/// Depth image and camera_info of equal stamps, rendered only while somebody listens.
class CameraPublisher {
 public:
  CameraPublisher(ros::NodeHandle& nh, const Parameters& params, std::uint64_t seed);

  /// Call it at every step; publishes at the camera's frequency.
  void publish(const World& world, const ros::Time& stamp);
  /// A new episode: noise from another seed.
  void restart(std::uint64_t seed) { camera_ = DepthCamera(camera_.params(), seed); }

 private:
  DepthCamera camera_;
  RateDivider rate_;
  ros::Publisher image_;
  ros::Publisher camera_info_;
};

}  // namespace kobuki_sim
