// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/itinerary.h"

#include <algorithm>
#include <cmath>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

Leg makeLeg(const Vector2d& from, const Vector2d& to, const RouteFunction& route) {
  Leg leg;
  leg.points = route(from, to);
  for (std::size_t i = 1; i < leg.points.size(); ++i)
    leg.length += (leg.points[i] - leg.points[i - 1]).norm();
  return leg;
}

double lengthOf(const Itinerary& itinerary, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < itinerary.legs.size(); ++i) sum += itinerary.legs[i].length;
  return sum;
}

/// Distance walked, folded into one pass over the legs.
double foldedDistance(const Itinerary& itinerary, double distance) {
  const double total = lengthOf(itinerary, 0);
  if (distance < total || itinerary.next_after_last < 0) return std::min(distance, total);
  const double cycle = lengthOf(itinerary, static_cast<std::size_t>(itinerary.next_after_last));
  if (!(cycle > 0.0)) return total;
  const double before = total - cycle;
  return before + std::fmod(distance - before, cycle);
}

TimetablePoint pointOnLeg(const Leg& leg, double distance, double speed) {
  for (std::size_t i = 1; i < leg.points.size(); ++i) {
    const Vector2d step = leg.points[i] - leg.points[i - 1];
    const double length = step.norm();
    if (length > 0.0 && distance < length) {
      return {leg.points[i - 1] + step * (distance / length), step * (speed / length)};
    }
    distance -= length;
  }
  return {leg.points.back(), Vector2d::Zero()};
}

}  // namespace

int Itinerary::next(int leg) const {
  return leg + 1 < static_cast<int>(legs.size()) ? leg + 1 : next_after_last;
}

Itinerary makeItinerary(const Vector2d& start, const std::vector<Vector2d>& waypoints, OnArrival on_arrival,
                        const RouteFunction& route) {
  Itinerary itinerary;
  if (waypoints.empty()) return itinerary;
  std::vector<Vector2d> stops{start};
  stops.insert(stops.end(), waypoints.begin(), waypoints.end());
  const auto add = [&](std::size_t from, std::size_t to) {
    itinerary.legs.push_back(makeLeg(stops[from], stops[to], route));
  };
  const std::size_t last = stops.size() - 1;
  for (std::size_t i = 0; i < last; ++i) add(i, i + 1);
  if (on_arrival == OnArrival::kLoop) {
    const bool single = last == 1;
    add(last, single ? 0 : 1);
    itinerary.next_after_last = single ? 0 : 1;
  } else if (on_arrival == OnArrival::kReverse) {
    for (std::size_t i = last; i > 0; --i) add(i, i - 1);
    itinerary.next_after_last = 0;
  } else if (on_arrival == OnArrival::kRespawn) {
    itinerary.next_after_last = 0;
    itinerary.jumps_back = true;
  }
  return itinerary;
}

TimetablePoint timetablePoint(const Itinerary& itinerary, const Vector2d& start, double speed, double time) {
  if (itinerary.legs.empty() || time < 0.0) return {start, Vector2d::Zero()};
  double distance = foldedDistance(itinerary, speed * time);
  for (const Leg& leg : itinerary.legs) {
    if (distance < leg.length) return pointOnLeg(leg, distance, speed);
    distance -= leg.length;
  }
  return {itinerary.legs.back().points.back(), Vector2d::Zero()};
}

}  // namespace kobuki_sim
