// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "kobuki_sim/world.h"
#include "kobuki_sim_ros/parameters.h"
#include "kobuki_sim_ros/rate_divider.h"

namespace kobuki_sim {

/// What only a simulator knows: where robot and people really are, and who touched whom.
class GroundTruthPublisher {
 public:
  GroundTruthPublisher(ros::NodeHandle& nh, const NodeParams& params);

  /// Same stamp as the odometry it belongs to.
  void publishOdometry(const World& world, const ros::Time& stamp);
  /// People at their frequency, contacts of the last step; call it at every step.
  void publishPeopleAndContacts(const World& world, const ros::Time& stamp);

 private:
  std::string base_frame_;
  RateDivider people_rate_;
  ros::Publisher odometry_;
  ros::Publisher people_;
  ros::Publisher contacts_;
};

}  // namespace kobuki_sim
