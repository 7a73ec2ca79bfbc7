// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/walker.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kLookPeriod = 0.5;         // [s] between two looks whether the way ahead is straight
constexpr double kDetourTime = 8.0;         // [s] for which a detour is not shortened
constexpr std::size_t kLongestWayBack = 3;  // [points] of the route
constexpr double kLeanPeriod = 1.0;         // [s] between two draws of the lean
constexpr double kStopTime = 0.5;           // [s] in which a person brakes at the last waypoint
constexpr double kToleranceGrowth =
    0.2;  // [m/s] somebody who stands on the waypoint makes it reached from farther
constexpr double kLargestTolerance = 1.5;  // [m]

Vector2d rotated(const Vector2d& v, double angle) { return Eigen::Rotation2Dd(angle) * v; }

}  // namespace

Walker::Walker(Itinerary itinerary, const Vector2d& start, RandomStream stream)
    : itinerary_(std::move(itinerary)),
      start_(start),
      random_(stream),
      next_look_(random_.uniform(0.0, kLookPeriod)) {
  restart();
}

void Walker::restart() {
  wants_to_return_ = false;
  blocked_time_ = 0.0;
  yield_until_ = 0.0;
  enterLeg(itinerary_.legs.empty() ? -1 : 0);
}

void Walker::enterLeg(int leg) {
  leg_ = leg;
  if (leg >= 0) {
    route_ = itinerary_.legs[static_cast<std::size_t>(leg)].points;
  } else {
    const Vector2d stay = route_.empty() ? start_ : Vector2d(route_.back());
    route_.assign(2, stay);
  }
  route_point_ = 1;
  detour_until_ = 0.0;
}

double Walker::arrivalTolerance(const CrowdParams& params) const {
  const bool stops_here = itinerary_.next(leg_) < 0;
  const double tolerance = stops_here ? params.stop_tolerance : params.waypoint_tolerance;
  return std::min(tolerance + kToleranceGrowth * blocked_time_, kLargestTolerance);
}

void Walker::passReachedPoints(const Vector2d& position, const CrowdParams& params) {
  while (!isLastPoint() && (route_[route_point_] - position).norm() < params.waypoint_tolerance)
    ++route_point_;
  if (leg_ < 0 || !isLastPoint() || (route_.back() - position).norm() >= arrivalTolerance(params)) return;
  const bool at_the_end = leg_ + 1 == static_cast<int>(itinerary_.legs.size());
  if (at_the_end && itinerary_.jumps_back) {
    wants_to_return_ = true;
    return;
  }
  blocked_time_ = 0.0;
  enterLeg(itinerary_.next(leg_));
}

/// Looks ahead: takes a shorter way when the next point but one is in sight. When the next point is not, goes
/// back to the last one that is, or asks for another route.
void Walker::refreshRoute(const PersonState& self, double time, const Router* router) {
  if (router == nullptr || time < next_look_ || time < detour_until_) return;
  next_look_ = time + kLookPeriod;
  const auto sees = [&](std::size_t k) { return router->sees(self.position, route_[k], 0.95 * self.radius); };
  if (!isLastPoint() && sees(route_point_ + 1)) {
    ++route_point_;
    return;
  }
  const std::size_t earliest = route_point_ > kLongestWayBack ? route_point_ - kLongestWayBack : 0;
  for (std::size_t k = route_point_ + 1; k-- > earliest;) {
    if (!sees(k)) continue;
    route_point_ = k;
    return;
  }
  if (router->route(self.position, Vector2d(route_.back()), self.radius, {}, route_)) route_point_ = 1;
}

void Walker::takeDetour(const PersonState& self, const std::vector<Disc>& obstacles, double time,
                        const Router& router) {
  if (!router.route(self.position, Vector2d(route_.back()), self.radius, obstacles, route_)) return;
  route_point_ = 1;
  detour_until_ = time + kDetourTime;
}

Vector2d Walker::lean(const Vector2d& direction, double time, const CrowdParams& params) {
  if (time >= next_lean_) {
    lean_angle_ = -params.pass_right_angle + random_.uniform(-params.direction_noise, params.direction_noise);
    next_lean_ = time + kLeanPeriod;
  }
  return rotated(direction, lean_angle_);
}

Vector2d Walker::preferredVelocity(const PersonState& self, double time, double period,
                                   const CrowdParams& params, const Router* router) {
  passReachedPoints(self.position, params);
  refreshRoute(self, time, router);
  if (isYielding(time)) return 0.6 * self.preferred_speed * yield_direction_;
  const Vector2d way = route_[route_point_] - self.position;
  const double distance = way.norm();
  const bool stops_here = isLastPoint() && (leg_ < 0 || itinerary_.next(leg_) < 0);
  if (distance < 1e-6 || (leg_ < 0 && distance < params.stop_tolerance)) {
    direction_.setZero();
    return Vector2d::Zero();
  }
  direction_ = way / distance;
  const double speed = std::min(
      {self.preferred_speed, stops_here ? distance / kStopTime : self.preferred_speed, distance / period});
  return speed * lean(direction_, time, params);
}

bool Walker::losesPatience(const PersonState& self, const Vector2d& chosen, double time, double period,
                           const CrowdParams& params) {
  if (isYielding(time) || leg_ < 0 || direction_.isZero()) return false;
  const bool blocked = chosen.dot(direction_) < params.blocked_speed * self.preferred_speed;
  blocked_time_ = blocked ? blocked_time_ + period : std::max(0.0, blocked_time_ - 0.5 * period);
  if (patience_ <= 0.0) tryOn(params);
  return blocked_time_ >= patience_;
}

void Walker::stepAside(const Vector2d& direction, double time, const CrowdParams& params) {
  yield_direction_ = direction;
  if (direction.isZero()) {
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    yield_direction_ = rotated(direction_, side * sarn::kPi * random_.uniform(0.5, 0.95));
  }
  yield_until_ = time + params.yield_time * random_.uniform(1.0, 2.0);
  tryOn(params);
}

void Walker::tryOn(const CrowdParams& params) {
  patience_ = blocked_time_ + params.patience * random_.uniform(1.0, 2.0);
}

}  // namespace kobuki_sim
