// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/lockstep_acknowledger.h"

#include <std_msgs/Time.h>

namespace sarn {
namespace {

const ros::WallDuration kIdle(0.2);  // nothing for this long: nothing is on its way
const ros::WallDuration kTimerPeriod(0.1);

}  // namespace

LockstepAcknowledger::LockstepAcknowledger(ros::NodeHandle nh, const std::string& topic) {
  publisher_ = nh.advertise<std_msgs::Time>(topic, 10);
  if (ros::Time::isSimTime()) {
    timer_ = nh.createWallTimer(kTimerPeriod, [this](const ros::WallTimerEvent&) { onWallTimer(); });
  }
}

void LockstepAcknowledger::acknowledge(const ros::Time& processed) {
  last_ = ros::WallTime::now();
  std_msgs::Time message;
  message.data = processed;
  publisher_.publish(message);
}

void LockstepAcknowledger::onWallTimer() {
  if (ros::WallTime::now() - last_ > kIdle) acknowledge(ros::Time::now());
}

}  // namespace sarn
