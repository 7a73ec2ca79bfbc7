// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/conversions.h"

#include <algorithm>
#include <cmath>

namespace sarn {
namespace {

template <class Point, class Quaternion>
std::optional<Pose2D> planarPose(const Point& p, const Quaternion& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !(std::abs(norm - 1.0) < 0.01)) return std::nullopt;
  if (std::abs(q.x) > 0.01 || std::abs(q.y) > 0.01) return std::nullopt;
  return Pose2D{p.x, p.y, wrapAngle(2.0 * std::atan2(q.z, q.w))};
}

template <class Quaternion>
void setYaw(double theta, Quaternion& q) {
  q.x = q.y = 0.0;
  q.z = std::sin(0.5 * theta);
  q.w = std::cos(0.5 * theta);
}

}  // namespace

std::optional<Pose2D> fromMessage(const geometry_msgs::Pose& message) {
  return planarPose(message.position, message.orientation);
}

geometry_msgs::Pose toMessage(const Pose2D& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  setYaw(pose.theta, message.orientation);
  return message;
}

std::optional<Pose2D> fromMessage(const geometry_msgs::Transform& message) {
  return planarPose(message.translation, message.rotation);
}

geometry_msgs::Transform toTransformMessage(const Pose2D& pose) {
  geometry_msgs::Transform message;
  message.translation.x = pose.x;
  message.translation.y = pose.y;
  setYaw(pose.theta, message.rotation);
  return message;
}

std::optional<Twist2D> fromMessage(const geometry_msgs::Twist& message) {
  if (!std::isfinite(message.linear.x) || !std::isfinite(message.angular.z)) return std::nullopt;
  return Twist2D{message.linear.x, message.angular.z};
}

geometry_msgs::Twist toMessage(const Twist2D& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.v;
  message.angular.z = twist.omega;
  return message;
}

std::string tag(const people_msgs::Person& person, const std::string& name) {
  const auto found = std::find(person.tagnames.begin(), person.tagnames.end(), name);
  const auto i = static_cast<std::size_t>(found - person.tagnames.begin());
  return i < person.tagnames.size() && i < person.tags.size() ? person.tags[i] : std::string();
}

std::vector<Person> fromMessage(const people_msgs::People& message) {
  std::vector<Person> people;
  for (const auto& entry : message.people) {
    const Eigen::Vector2d position(entry.position.x, entry.position.y);
    const Eigen::Vector2d velocity(entry.velocity.x, entry.velocity.y);
    if (!position.allFinite() || !velocity.allFinite()) continue;
    people.push_back({entry.name, tag(entry, "group"), position, velocity, entry.reliability});
  }
  return people;
}

people_msgs::Person toMessage(const Person& person) {
  people_msgs::Person message;
  message.name = person.name;
  message.position.x = person.position.x();
  message.position.y = person.position.y();
  message.velocity.x = person.velocity.x();
  message.velocity.y = person.velocity.y();
  message.reliability = person.reliability;
  message.tagnames = {"group"};
  message.tags = {person.group};
  return message;
}

PeoplePrediction fromMessage(const sarn_msgs::PeoplePrediction& message) {
  PeoplePrediction prediction{message.header.stamp.toSec(), message.time_step.toSec(), {}};
  for (const auto& entry : message.people) {
    PersonPrediction person{entry.name, entry.group, {}};
    for (const auto& s : entry.states) person.states.push_back({{s.x, s.y}, {s.vx, s.vy}, s.sigma});
    prediction.people.push_back(std::move(person));
  }
  return prediction;
}

sarn_msgs::PeoplePrediction toMessage(const PeoplePrediction& prediction, const std::string& frame) {
  sarn_msgs::PeoplePrediction message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time(prediction.stamp);
  message.time_step = ros::Duration(prediction.time_step);
  for (const auto& person : prediction.people) {
    sarn_msgs::PersonPrediction entry;
    entry.name = person.name;
    entry.group = person.group;
    for (const auto& state : person.states) {
      sarn_msgs::PredictedState s;
      s.x = state.position.x();
      s.y = state.position.y();
      s.vx = state.velocity.x();
      s.vy = state.velocity.y();
      s.sigma = state.sigma;
      entry.states.push_back(s);
    }
    message.people.push_back(std::move(entry));
  }
  return message;
}

TimedTrajectory fromMessage(const sarn_msgs::TimedTrajectory& message) {
  TimedTrajectory trajectory;
  const double start = message.header.stamp.toSec();
  for (const auto& p : message.points) {
    trajectory.points.push_back({p.x, p.y, p.theta, p.v, p.omega, start + p.time_from_start.toSec()});
  }
  return trajectory;
}

sarn_msgs::TimedTrajectory toMessage(const TimedTrajectory& trajectory, const std::string& frame) {
  sarn_msgs::TimedTrajectory message;
  message.header.frame_id = frame;
  message.header.stamp = ros::Time(trajectory.startTime());
  for (const auto& p : trajectory.points) {
    sarn_msgs::TimedTrajectoryPoint point;
    point.time_from_start = ros::Duration(p.t - trajectory.startTime());
    point.x = p.x;
    point.y = p.y;
    point.theta = p.theta;
    point.v = p.v;
    point.omega = p.omega;
    message.points.push_back(point);
  }
  return message;
}

std::optional<OccupancyMap> fromMessage(const nav_msgs::OccupancyGrid& message) {
  const auto origin = fromMessage(message.info.origin);
  const std::size_t cells = static_cast<std::size_t>(message.info.width) * message.info.height;
  if (!origin || std::abs(origin->theta) > 1e-6 || !(message.info.resolution > 0.0F)) return std::nullopt;
  if (cells == 0 || message.data.size() != cells) return std::nullopt;
  OccupancyMap map;
  // A float 0.05 is not the double 0.05: round to micrometres.
  const double resolution = std::round(static_cast<double>(message.info.resolution) * 1e6) * 1e-6;
  map.geometry = {static_cast<int>(message.info.width), static_cast<int>(message.info.height), resolution,
                  origin->x, origin->y};
  map.cells.assign(message.data.begin(), message.data.end());
  return map;
}

nav_msgs::OccupancyGrid toMessage(const OccupancyMap& map, const std::string& frame) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame;
  message.info.width = static_cast<std::uint32_t>(map.geometry.width);
  message.info.height = static_cast<std::uint32_t>(map.geometry.height);
  message.info.resolution = static_cast<float>(map.geometry.resolution);
  message.info.origin = toMessage(Pose2D{map.geometry.origin_x, map.geometry.origin_y, 0.0});
  message.data.assign(map.cells.begin(), map.cells.end());
  return message;
}

}  // namespace sarn
