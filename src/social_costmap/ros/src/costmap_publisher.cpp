// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap_ros/costmap_publisher.h"

#include <nav_msgs/OccupancyGrid.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <utility>

#include "social_costmap_ros/conversions.h"
#include "social_costmap_ros/markers.h"
#include "social_costmap_ros/topics.h"

namespace social_costmap_ros {

CostmapPublisher::CostmapPublisher(const ros::NodeHandle& nh, std::string frame)
    : nh_(nh),
      frame_(std::move(frame)),
      static_publisher_(nh_.advertise<nav_msgs::OccupancyGrid>(kStaticCostsTopic, 1)),
      social_publisher_(nh_.advertise<nav_msgs::OccupancyGrid>(kSocialCostsTopic, 1)),
      markers_publisher_(nh_.advertise<visualization_msgs::MarkerArray>(kPeopleMarkersTopic, 1)) {}

void CostmapPublisher::publish(const social_costmap::Snapshot& snapshot, int layer) {
  const sarn::GridGeometry& geometry = snapshot.static_costs.geometry;
  if (static_publisher_.getNumSubscribers() > 0) {
    static_publisher_.publish(
        toMessage(geometry, snapshot.static_costs.cells.data(), frame_, snapshot.stamp));
  }
  if (social_publisher_.getNumSubscribers() > 0 && !snapshot.layers.empty()) {
    const int last = static_cast<int>(snapshot.layers.size()) - 1;
    const auto shown = static_cast<std::size_t>(std::clamp(layer, 0, last));
    social_publisher_.publish(
        toMessage(geometry, snapshot.layers[shown].cells.data(), frame_, snapshot.stamp));
  }
}

void CostmapPublisher::publishPeople(const sarn::PeoplePrediction& prediction,
                                     const social_costmap::SocialParams& params, double time) {
  if (markers_publisher_.getNumSubscribers() == 0) return;
  markers_publisher_.publish(peopleMarkers(prediction, params, time, frame_));
}

}  // namespace social_costmap_ros
