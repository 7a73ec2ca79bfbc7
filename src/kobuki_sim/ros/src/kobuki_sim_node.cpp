// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/kobuki_sim_node.h"

#include <ros/console.h>
#include <ros/init.h>
#include <std_msgs/Time.h>

#include <algorithm>
#include <string>

#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr double kMaxWait = 0.1;              // [s] wall: how soon a shutdown is noticed
constexpr std::uint32_t kMaxSteps = 1000000;  // of one call of the step service
constexpr std::uint32_t kLockstepQueue = 100;

double wallTime() { return ros::WallTime::now().toSec(); }
std::int64_t nanoseconds(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

}  // namespace

KobukiSimNode::KobukiSimNode(ros::NodeHandle& nh, const Parameters& params, const Scenario& scenario,
                             std::uint64_t seed)
    : params_(params.node),
      queue_(*ros::getGlobalCallbackQueue()),
      simulation_(nh, params, scenario, seed),
      gate_(params.lockstep, params.node.lockstep_timeout),
      pacer_(params.node.rate > 0.0 ? params.node.rate : 1.0),
      paused_(params.node.start_paused),
      reset_(nh.advertiseService(kResetService, &KobukiSimNode::onReset, this)),
      pause_(nh.advertiseService(kPauseService, &KobukiSimNode::onPause, this)),
      step_(nh.advertiseService(kStepService, &KobukiSimNode::onStep, this)),
      inject_(nh.advertiseService(kInjectService, &KobukiSimNode::onInject, this)) {
  for (std::size_t i = 0; i < params.lockstep.size(); ++i) {
    lockstep_.push_back(nh.subscribe<std_msgs::Time>(
        kLockstepPrefix + params.lockstep[i].name, kLockstepQueue,
        [this, i](const std_msgs::TimeConstPtr& message) { acknowledge(i, message->data); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }
}

void KobukiSimNode::spin() {
  while (ros::ok()) {
    if (paused_) {
      waitWhilePaused();
    } else if (waitForNextStep()) {
      simulation_.step();
    }
  }
}

void KobukiSimNode::waitWhilePaused() {
  pacer_.stop();
  serveCallbacks(kMaxWait);
}

void KobukiSimNode::serveCallbacks(double duration) {
  const double now = wallTime();
  if (now - last_reminder_ >= kMaxWait) {
    simulation_.publishClock();
    last_reminder_ = now;
  }
  queue_.callAvailable(ros::WallDuration(std::min(duration, kMaxWait)));
}

bool KobukiSimNode::waitForNextStep() {
  queue_.callAvailable();
  if (paused_) return false;
  double wait = 0.0;
  if (params_.rate > 0.0) {
    wait = pacer_.delay(nanoseconds(simulation_.next()), wallTime());
  } else if (!gate_.mayReach(nanoseconds(simulation_.next()), wallTime())) {
    wait = kMaxWait;
  }
  for (const auto& name : gate_.takeGivenUp()) {
    ROS_WARN_STREAM("/" << kLockstepPrefix << name << ": no acknowledgement for " << params_.lockstep_timeout
                        << " s; going on without it");
  }
  if (wait <= 0.0) return true;
  serveCallbacks(wait);
  return false;
}

void KobukiSimNode::acknowledge(std::size_t participant, const ros::Time& stamp) {
  gate_.acknowledge(participant, nanoseconds(stamp), nanoseconds(simulation_.now()));
}

bool KobukiSimNode::onReset(sarn_msgs::Reset::Request& request, sarn_msgs::Reset::Response& response) {
  const std::uint64_t seed = request.keep_seed ? simulation_.world().seed() : request.seed;
  simulation_.reset(seed);
  response.success = 1;
  response.message = "seed " + std::to_string(seed);
  return true;
}

bool KobukiSimNode::onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  paused_ = request.data != 0;
  response.success = 1;
  response.message = paused_ ? "paused" : "running";
  return true;
}

bool KobukiSimNode::onStep(sarn_msgs::Step::Request& request, sarn_msgs::Step::Response& response) {
  response.success = paused_ && request.steps <= kMaxSteps ? 1 : 0;
  if (!paused_) {
    response.message = "the simulation is running; pause it first";
  } else if (request.steps > kMaxSteps) {
    response.message = "steps must be at most " + std::to_string(kMaxSteps);
  } else {
    for (std::uint32_t i = 0; i < request.steps && ros::ok(); ++i) simulation_.step();
  }
  response.time = simulation_.now();
  return true;
}

bool KobukiSimNode::onInject(sarn_msgs::InjectEvent::Request& request,
                             sarn_msgs::InjectEvent::Response& response) {
  response.message = simulation_.inject(request.event, request.active != 0);
  response.success = response.message.empty() ? 1 : 0;
  return true;
}

}  // namespace kobuki_sim
