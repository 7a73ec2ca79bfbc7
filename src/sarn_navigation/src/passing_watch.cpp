// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/passing_watch.h"

#include <algorithm>
#include <cmath>

namespace sarn_navigation {
namespace {

constexpr double kBeyond = 0.9;        // [m] past the place: out of the robot's way
constexpr double kBesideWay = 1.2;     // [m] from the line on which the person walked
constexpr double kWalkingOn = 0.25;    // [m/s] along that line
constexpr double kHesitation = 1.5;    // times the time that the way takes
constexpr double kReaction = 1.0;      // [s] until somebody who waited walks on
constexpr double kSlowestWalk = 0.25;  // [m/s]

}  // namespace

PassingWatch::PassingWatch(const BlockedPerson& person, const Eigen::Vector2d& origin, double now)
    : person_(person),
      origin_(origin),
      direction_(person.velocity.normalized()),
      speed_(std::max(kSlowestWalk, person.velocity.norm())),
      last_seen_(now) {}

void PassingWatch::observe(const sarn::PeoplePrediction& people) {
  in_sight_ = false;
  for (const auto& person : people.people) {
    if (person.states.empty()) continue;
    const sarn::PredictedState& now = person.states.front();
    const Eigen::Vector2d from_origin = now.position - origin_;
    const double beyond = direction_.dot(from_origin);
    const double beside = (from_origin - beyond * direction_).norm();
    // Who comes back into view may have another name.
    const bool walks_on = direction_.dot(now.velocity) > kWalkingOn;
    if (beyond > kBeyond && beside < kBesideWay && walks_on) seen_beyond_ = true;
    if (person.name != person_.name) continue;
    in_sight_ = true;
    last_seen_ = people.stamp;
    person_.position = now.position;
  }
}

void PassingWatch::robotIsAside(double now) {
  if (aside_ < 0.0) aside_ = now;
}

bool PassingWatch::mayStillCome(double now) const {
  if (in_sight_ || seen_beyond_) return false;
  if (aside_ < 0.0) return true;
  const double way = std::max(0.0, direction_.dot(origin_ - person_.position)) + kBeyond;
  return now < std::max(aside_, last_seen_) + kReaction + kHesitation * way / speed_;
}

}  // namespace sarn_navigation
