// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/lidar_publisher.h"

#include <sensor_msgs/LaserScan.h>

#include "kobuki_sim_ros/conversions.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kQueue = 5;

}  // namespace

LidarPublisher::LidarPublisher(ros::NodeHandle& nh, const Parameters& params, std::uint64_t seed)
    : frequency_(params.node.lidar_frequency), lidar_(params.lidar, seed) {
  if (!(frequency_ > 0.0)) return;
  rate_.emplace(frequency_);
  scan_ = nh.advertise<sensor_msgs::LaserScan>(kScanTopic, kQueue);
}

void LidarPublisher::restart(std::uint64_t seed) { lidar_ = Lidar(lidar_.params(), seed); }

void LidarPublisher::publish(const World& world, const ros::Time& stamp) {
  if (!rate_ || !rate_->due(static_cast<std::int64_t>(stamp.toNSec()))) return;
  if (scan_.getNumSubscribers() == 0) return;
  const LidarScan& scan = lidar_.measure(world.map(), world.robotPose(), world.people(), world.steps());
  scan_.publish(toLaserScan(scan, 1.0 / frequency_, stamp));
}

}  // namespace kobuki_sim
