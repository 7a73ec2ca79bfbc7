// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap_ros/markers.h"

#include <ros/time.h>

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"
#include "social_costmap/person_path.h"
#include "social_costmap/person_space.h"

namespace social_costmap_ros {
namespace {

constexpr double kCylinderHeight = 1.8;  // [m]
constexpr double kSkirtHeight = 1.2;     // [m] at cost 252
constexpr int kSectors = 32;             // of the skirt's surface
constexpr int kRings = 10;

visualization_msgs::Marker makeMarker(const std::string& frame, double time, const char* kind, int id) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = ros::Time(time);
  marker.ns = kind;
  marker.id = id;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
  std_msgs::ColorRGBA c;
  c.r = r;
  c.g = g;
  c.b = b;
  c.a = a;
  return c;
}

visualization_msgs::Marker forbiddenCylinder(visualization_msgs::Marker marker,
                                             const Eigen::Vector2d& position, double radius) {
  marker.type = visualization_msgs::Marker::CYLINDER;
  marker.pose.position.x = position.x();
  marker.pose.position.y = position.y();
  marker.pose.position.z = 0.5 * kCylinderHeight;
  marker.scale.x = marker.scale.y = 2.0 * radius;
  marker.scale.z = kCylinderHeight;
  marker.color = colour(0.9F, 0.1F, 0.1F, 0.6F);
  return marker;
}

/// Point of the skirt where the cost has fallen to amplitude * exp(-ring^2 / 2), in a direction of the
/// Gaussian.
geometry_msgs::Point skirtPoint(const social_costmap::SweptGaussian& g, double ring, int sector) {
  const double angle = 2.0 * sarn::kPi * sector / kSectors;
  const double along = std::cos(angle) * ring * (std::cos(angle) > 0.0 ? g.sigma_front : g.sigma_rear);
  const double across = std::sin(angle) * ring * g.sigma_side;
  geometry_msgs::Point point;
  point.x = g.start.x() + std::cos(g.heading) * along - std::sin(g.heading) * across;
  point.y = g.start.y() + std::sin(g.heading) * along + std::cos(g.heading) * across;
  point.z = kSkirtHeight / 252.0 * social_costmap::costAt(g, {point.x, point.y});
  return point;
}

visualization_msgs::Marker skirt(visualization_msgs::Marker marker, const social_costmap::SweptGaussian& g,
                                 double cutoff) {
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = colour(0.2F, 0.4F, 1.0F, 0.45F);
  const double outermost = std::sqrt(2.0 * std::log(g.amplitude / cutoff));
  for (int ring = 0; ring < kRings; ++ring) {
    const double inner = outermost * ring / kRings;
    const double outer = outermost * (ring + 1) / kRings;
    for (int sector = 0; sector < kSectors; ++sector) {
      const auto a = skirtPoint(g, inner, sector);
      const auto b = skirtPoint(g, outer, sector);
      const auto c = skirtPoint(g, outer, sector + 1);
      const auto d = skirtPoint(g, inner, sector + 1);
      marker.points.insert(marker.points.end(), {a, b, c, a, c, d});
    }
  }
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray peopleMarkers(const sarn::PeoplePrediction& prediction,
                                              const social_costmap::SocialParams& params, double time,
                                              const std::string& frame) {
  visualization_msgs::MarkerArray all;
  all.markers.push_back(makeMarker(frame, time, "", 0));
  all.markers.back().action = visualization_msgs::Marker::DELETEALL;
  if (!std::isfinite(prediction.stamp) || !(prediction.time_step > 0.0) || !std::isfinite(time)) return all;
  int id = 0;
  for (const sarn::PersonPrediction& person : prediction.people) {
    const std::size_t usable = social_costmap::usableStates(person);
    if (usable == 0) continue;
    const social_costmap::PersonPath path(person, usable, prediction.stamp, prediction.time_step, params);
    const social_costmap::PersonState state = path.at(time);
    const double radius = social_costmap::forbiddenRadius(params, state.sigma, 0);
    if (radius > 0.0) {
      all.markers.push_back(
          forbiddenCylinder(makeMarker(frame, time, "forbidden", id), state.position, radius));
    }
    const social_costmap::SweptGaussian gaussian = social_costmap::gaussianOf(params, state, state, 0);
    if (gaussian.amplitude > params.cutoff_amplitude) {
      all.markers.push_back(skirt(makeMarker(frame, time, "social", id), gaussian, params.cutoff_amplitude));
    }
    ++id;
  }
  return all;
}

}  // namespace social_costmap_ros
