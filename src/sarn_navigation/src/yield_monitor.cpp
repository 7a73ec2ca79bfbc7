// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/yield_monitor.h"

#include <algorithm>
#include <cmath>

namespace sarn_navigation {
namespace {

constexpr double kWalkingSpeed = 0.25;  // [m/s] slower people stand
constexpr double kHaltMemory = 6.0;     // [s] a halted person's direction is remembered this long
constexpr double kHaltDistance = 1.5;   // [m] a person halted by the robot stands this close to it
constexpr double kForgetAfter = 2.0;    // [s] unseen people are dropped

}  // namespace

double distanceToWay(const Eigen::Vector2d& p, const BlockedPerson& person) {
  const Eigen::Vector2d direction = person.velocity.normalized();
  const double ahead = std::max(0.0, direction.dot(p - person.position));
  return (p - person.position - ahead * direction).norm();
}

void YieldMonitor::observe(const sarn::PeoplePrediction& people) {
  stamp_ = people.stamp;
  for (const auto& person : people.people) {
    if (person.states.empty()) continue;
    const sarn::PredictedState& now = person.states.front();
    Track& track = tracks_[person.name];
    track.position = now.position;
    track.stamp = stamp_;
    track.walking = now.velocity.norm() >= kWalkingSpeed;
    if (track.walking) {
      track.walking_velocity = now.velocity;
      track.walking_stamp = stamp_;
    }
  }
  for (auto it = tracks_.begin(); it != tracks_.end();) {
    const bool stale = std::abs(stamp_ - it->second.stamp) > kForgetAfter;
    it = stale ? tracks_.erase(it) : std::next(it);
  }
}

bool YieldMonitor::leadsThrough(const Track& track, const Eigen::Vector2d& robot) const {
  const Eigen::Vector2d to_robot = robot - track.position;
  const double speed = track.walking_velocity.norm();
  if (speed < kWalkingSpeed) return false;
  if (!track.walking) {
    const bool halted_here = to_robot.norm() < kHaltDistance && stamp_ - track.walking_stamp < kHaltMemory;
    if (!halted_here) return false;
  }
  const Eigen::Vector2d direction = track.walking_velocity / speed;
  const double ahead = direction.dot(to_robot);  // [m] along the person's way
  const double aside = std::abs(direction.x() * to_robot.y() - direction.y() * to_robot.x());
  return ahead > 0.0 && ahead < speed * params_.yield_horizon && aside < params_.yield_distance;
}

std::optional<BlockedPerson> YieldMonitor::blockedBy(const Eigen::Vector2d& robot) const {
  std::optional<BlockedPerson> nearest;
  double nearest_distance = HUGE_VAL;
  for (const auto& [name, track] : tracks_) {
    const double distance = (robot - track.position).norm();
    if (distance < nearest_distance && leadsThrough(track, robot)) {
      nearest_distance = distance;
      nearest = BlockedPerson{name, track.position, track.walking_velocity};
    }
  }
  return nearest;
}

}  // namespace sarn_navigation
