// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/prediction_markers.h"

namespace sarn_perception {
namespace {

constexpr double kDiameter = 0.2;  // [m]
constexpr double kHeight = 0.1;    // [m] of the spheres' centres

visualization_msgs::Marker row(const sarn::PersonPrediction& person) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::SPHERE_LIST;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = kDiameter;
  const auto count = static_cast<float>(person.states.size());
  for (std::size_t i = 0; i < person.states.size(); ++i) {
    geometry_msgs::Point point;
    point.x = person.states[i].position.x();
    point.y = person.states[i].position.y();
    point.z = kHeight;
    std_msgs::ColorRGBA color;
    color.b = 0.55F;
    color.a = 1.0F - static_cast<float>(i) / count;
    marker.points.push_back(point);
    marker.colors.push_back(color);
  }
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray PredictionMarkers::draw(const sarn::PeoplePrediction& prediction,
                                                        const std::string& frame) {
  visualization_msgs::MarkerArray markers;
  std::map<std::string, int> drawn;
  const auto add = [&](visualization_msgs::Marker marker, int id) {
    marker.header.frame_id = frame;
    marker.header.stamp = ros::Time(prediction.stamp);
    marker.ns = "prediction";
    marker.id = id;
    markers.markers.push_back(marker);
  };
  for (const sarn::PersonPrediction& person : prediction.people) {
    const auto known = ids_.find(person.name);
    const int id = known != ids_.end() ? known->second : next_id_++;
    drawn[person.name] = id;
    add(row(person), id);
  }
  for (const auto& [name, id] : ids_) {
    if (drawn.count(name) != 0) continue;
    visualization_msgs::Marker gone;
    gone.action = visualization_msgs::Marker::DELETE;
    gone.pose.orientation.w = 1.0;
    add(gone, id);
  }
  ids_ = drawn;
  return markers;
}

}  // namespace sarn_perception
