// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <string>

namespace sarn {

/// Tells a simulation that runs as fast as its nodes keep up how far this node has come: std_msgs/Time on a
/// lockstep topic. A node to which nothing comes for a moment of wall time has come as far as the clock:
/// without that, a world that waits for the node and a node that waits for the world would stand still for
/// ever (as at start-up, before the node's subscriptions exist).
class LockstepAcknowledger {
 public:
  LockstepAcknowledger(ros::NodeHandle nh, const std::string& topic);

  /// Everything up to this simulated time has been processed.
  void acknowledge(const ros::Time& processed);

 private:
  void onWallTimer();

  ros::Publisher publisher_;
  ros::WallTime last_;
  ros::WallTimer timer_;
};

}  // namespace sarn
