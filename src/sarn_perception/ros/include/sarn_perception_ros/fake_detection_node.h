// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <people_msgs/People.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <optional>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_perception/fake_detector.h"

namespace sarn_perception {

/// ground_truth/people -> people: what a detector on the robot would report, when it would report it.
class FakeDetectionNode {
 public:
  /// Throws sarn::ParameterError.
  FakeDetectionNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void takeMap(const nav_msgs::OccupancyGridConstPtr& map);
  void takePeople(const people_msgs::PeopleConstPtr& truth);
  void measure(const people_msgs::PeopleConstPtr& truth);
  [[nodiscard]] bool due(const ros::Time& stamp);
  [[nodiscard]] std::optional<sarn::Pose2D> sensorPose(const std::string& map_frame,
                                                       const ros::Time& stamp) const;
  void publishDue();

  ros::NodeHandle nh_;
  FakeDetectionParams params_;
  FakeDetector detector_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  sarn::LockstepAcknowledger lockstep_;
  std::string map_frame_;                       // of the map; empty before there is one
  ros::Time last_truth_;                        // stamp
  ros::Time next_measurement_;                  // stamp
  std::deque<people_msgs::People> on_the_way_;  // measured, not yet published
  ros::Publisher publisher_;
  ros::Subscriber map_subscriber_;
  ros::Subscriber people_subscriber_;
  ros::Timer timer_;
};

}  // namespace sarn_perception
