// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <people_msgs/People.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_perception/constant_velocity_predictor.h"
#include "sarn_perception_ros/prediction_markers.h"

namespace sarn_perception {

/// people -> people_prediction at a fixed rate, in the planning frame; an empty prediction says that nobody
/// is known, none at all that the predictor is dead.
class PredictionNode {
 public:
  /// Throws sarn::ParameterError.
  PredictionNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void takeMap(const nav_msgs::OccupancyGridConstPtr& map);
  void takePeople(const people_msgs::PeopleConstPtr& people);
  void observe(const people_msgs::PeopleConstPtr& people);
  [[nodiscard]] std::optional<people_msgs::People> inPlanningFrame(const people_msgs::People& people) const;
  [[nodiscard]] std::optional<ros::Time> usableStamp(const ros::Time& stamp) const;
  void watchClock();
  void publish();

  ros::NodeHandle nh_;
  PredictionParams params_;
  ConstantVelocityPredictor predictor_;
  PredictionMarkers markers_;
  ros::Time last_now_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  sarn::LockstepAcknowledger lockstep_;
  ros::Publisher prediction_publisher_;
  ros::Publisher marker_publisher_;
  ros::Subscriber map_subscriber_;
  ros::Subscriber people_subscriber_;
  ros::Timer timer_;
};

}  // namespace sarn_perception
