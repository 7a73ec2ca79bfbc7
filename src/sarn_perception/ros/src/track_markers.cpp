// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/track_markers.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

namespace sarn_perception {
namespace {

constexpr double kHeight = 1.7;    // [m]
constexpr double kDiameter = 0.4;  // [m]
constexpr double kMoves = 0.1;     // [m/s] slower people get no arrow

geometry_msgs::Point pointAt(const Eigen::Vector2d& position, double height) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = height;
  return point;
}

visualization_msgs::Marker marker(const std_msgs::Header& header, const PersonTrack& track, const char* what,
                                  std::int32_t type) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = what;
  marker.id = static_cast<std::int32_t>(track.id);
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.color.r = 0.9F;
  marker.color.g = 0.5F;
  marker.color.b = 0.1F;
  marker.color.a = 1.0F;
  return marker;
}

visualization_msgs::Marker figure(const std_msgs::Header& header, const PersonTrack& track) {
  auto result = marker(header, track, "person", visualization_msgs::Marker::CYLINDER);
  result.pose.position = pointAt(track.filter.position(), 0.5 * kHeight);
  result.scale.x = result.scale.y = kDiameter;
  result.scale.z = kHeight;
  result.color.a = static_cast<float>(0.7 * track.existence);
  return result;
}

visualization_msgs::Marker arrow(const std_msgs::Header& header, const PersonTrack& track) {
  auto result = marker(header, track, "velocity", visualization_msgs::Marker::ARROW);
  result.points = {pointAt(track.filter.position(), 0.1),
                   pointAt(track.filter.position() + track.filter.velocity(), 0.1)};
  result.scale.x = 0.05;
  result.scale.y = 0.12;
  return result;
}

visualization_msgs::Marker label(const std_msgs::Header& header, const PersonTrack& track) {
  auto result = marker(header, track, "name", visualization_msgs::Marker::TEXT_VIEW_FACING);
  result.pose.position = pointAt(track.filter.position(), kHeight + 0.2);
  result.scale.z = 0.25;
  result.text = std::to_string(track.id);
  return result;
}

visualization_msgs::Marker ellipse(const std_msgs::Header& header, const PersonTrack& track) {
  auto result = marker(header, track, "uncertainty", visualization_msgs::Marker::CYLINDER);
  const Eigen::Matrix2d covariance = track.filter.covariance().topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Vector2d longest = axes.eigenvectors().col(1);
  const double yaw = std::atan2(longest.y(), longest.x());
  result.pose.position = pointAt(track.filter.position(), 0.02);
  result.pose.orientation.z = std::sin(0.5 * yaw);
  result.pose.orientation.w = std::cos(0.5 * yaw);
  result.scale.x = 4.0 * std::sqrt(axes.eigenvalues()(1));
  result.scale.y = 4.0 * std::sqrt(axes.eigenvalues()(0));
  result.scale.z = 0.02;
  result.color.a = 0.4F;
  return result;
}

}  // namespace

visualization_msgs::MarkerArray trackMarkers(const std::vector<PersonTrack>& tracks,
                                             const std_msgs::Header& header) {
  visualization_msgs::MarkerArray markers;
  markers.markers.emplace_back();
  markers.markers.back().header = header;
  markers.markers.back().action = visualization_msgs::Marker::DELETEALL;
  for (const PersonTrack& track : tracks) {
    markers.markers.push_back(figure(header, track));
    markers.markers.push_back(label(header, track));
    markers.markers.push_back(ellipse(header, track));
    if (track.filter.velocity().norm() > kMoves) markers.markers.push_back(arrow(header, track));
  }
  return markers;
}

}  // namespace sarn_perception
