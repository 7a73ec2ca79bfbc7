// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <sarn_msgs/InjectEvent.h>
#include <sarn_msgs/Reset.h>
#include <sarn_msgs/Step.h>
#include <std_srvs/SetBool.h>

#include <cstdint>
#include <vector>

#include "kobuki_sim_ros/lockstep_gate.h"
#include "kobuki_sim_ros/parameters.h"
#include "kobuki_sim_ros/real_time_pacer.h"
#include "kobuki_sim_ros/simulation.h"

namespace kobuki_sim {

/// Drives the simulation: in real time, as fast as the participants keep up, or step by step. All callbacks
/// run between steps, in the thread of spin().
class KobukiSimNode {
 public:
  /// Throws ScenarioError, sarn::MapError, sarn::ParameterError.
  KobukiSimNode(ros::NodeHandle& nh, const Parameters& params, const Scenario& scenario, std::uint64_t seed);

  /// Until ROS shuts down.
  void spin();

 private:
  /// Serves callbacks until the next step may be done, for a while at most; whether it may.
  bool waitForNextStep();
  void waitWhilePaused();
  /// For `duration` [s] of wall time at most. Repeats the clock at 10 Hz, for whoever joins while the world
  /// stands.
  void serveCallbacks(double duration);
  void acknowledge(std::size_t participant, const ros::Time& stamp);

  bool onReset(sarn_msgs::Reset::Request& request, sarn_msgs::Reset::Response& response);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool onStep(sarn_msgs::Step::Request& request, sarn_msgs::Step::Response& response);
  bool onInject(sarn_msgs::InjectEvent::Request& request, sarn_msgs::InjectEvent::Response& response);

  NodeParams params_;
  ros::CallbackQueue& queue_;
  Simulation simulation_;
  LockstepGate gate_;
  RealTimePacer pacer_;
  bool paused_;
  double last_reminder_ = 0.0;  // [s] wall
  std::vector<ros::Subscriber> lockstep_;
  ros::ServiceServer reset_, pause_, step_, inject_;
};

}  // namespace kobuki_sim
