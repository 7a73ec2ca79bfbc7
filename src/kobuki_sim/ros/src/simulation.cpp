// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/simulation.h"

#include <rosgraph_msgs/Clock.h>

#include <cmath>

#include "kobuki_sim_ros/injected_events.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kClockQueue = 100;  // one second

}  // namespace

Simulation::Simulation(ros::NodeHandle& nh, const Parameters& params, const Scenario& scenario,
                       std::uint64_t seed)
    : params_(params),
      world_(scenario, seed, params.base),
      step_length_(static_cast<std::uint64_t>(std::llround(1e9 * world_.timeStep()))),
      clock_(nh.advertise<rosgraph_msgs::Clock>(kClockTopic, kClockQueue)),
      commands_(nh, world_),
      base_publisher_(nh, params.node, world_.timeStep()),
      camera_publisher_(nh, params, seed),
      lidar_publisher_(nh, params, seed),
      truth_publisher_(nh, params.node) {
  world_.base().odometry().useGyroHeading(params_.node.use_imu_heading);
}

ros::Time Simulation::timeAt(std::uint64_t steps) const {
  ros::Time time;
  time.fromNSec(steps * step_length_);
  return time;
}

void Simulation::publishClock() {
  rosgraph_msgs::Clock message;
  message.clock = now();
  clock_.publish(message);
}

void Simulation::step() {
  world_.step();
  ++steps_;
  publishClock();
  const ros::Time stamp = now();
  if (base_publisher_.publish(world_.base(), stamp)) truth_publisher_.publishOdometry(world_, stamp);
  truth_publisher_.publishPeopleAndContacts(world_, stamp);
  base_publisher_.publishDiagnostics(world_.base(), stamp);
  camera_publisher_.publish(world_, stamp);
  lidar_publisher_.publish(world_, stamp);
  commands_.warnOfTimeout();
}

void Simulation::reset(std::uint64_t seed) {
  world_.reset(seed);
  world_.base().odometry().useGyroHeading(params_.node.use_imu_heading);
  base_publisher_.restart();
  camera_publisher_.restart(seed);
  lidar_publisher_.restart(seed);
}

std::string Simulation::inject(const std::string& event, bool active) {
  return injectEvent(world_.base(), params_.node, event, active);
}

}  // namespace kobuki_sim
