// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "sarn_common/people.h"
#include "social_costmap/timed_costmap.h"

namespace social_costmap_ros {

/// Shows a snapshot in RViz. Messages are only made for topics that somebody listens to.
class CostmapPublisher {
 public:
  /// Topics of topics.h below nh's namespace; frame: of the costmap.
  CostmapPublisher(const ros::NodeHandle& nh, std::string frame);

  /// layer: index of the time layer to show, clamped to the last.
  void publish(const social_costmap::Snapshot& snapshot, int layer = 0);
  void publishPeople(const sarn::PeoplePrediction& prediction, const social_costmap::SocialParams& params,
                     double time);

 private:
  ros::NodeHandle nh_;
  std::string frame_;
  ros::Publisher static_publisher_;
  ros::Publisher social_publisher_;
  ros::Publisher markers_publisher_;
};

}  // namespace social_costmap_ros
