// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <string>

#include "sarn_common/people.h"
#include "sarn_navigation/navigator.h"
#include "social_costmap/timed_costmap.h"
#include "social_costmap_ros/costmap_publisher.h"

namespace sarn_navigation {

/// What RViz and the bag see of the navigator: each plan, and costs and people while somebody listens.
class NavigatorDisplay {
 public:
  NavigatorDisplay(ros::NodeHandle private_nh, std::string frame, double frequency);

  void remember(const sarn::PeoplePrediction& people) { people_ = people; }
  void showPlan(const sarn::TimedTrajectory& trajectory, const NavigatorStatus& status);
  /// At most `frequency` times a second of simulated time.
  void showCosts(const social_costmap::Snapshot& snapshot, const social_costmap::SocialParams& social);

 private:
  std::string frame_;
  double period_;      // [s]
  double next_ = 0.0;  // [s]
  sarn::PeoplePrediction people_;
  ros::Publisher path_;
  ros::Publisher trajectory_;
  social_costmap_ros::CostmapPublisher costs_;
};

}  // namespace sarn_navigation
