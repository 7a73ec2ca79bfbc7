// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "kobuki_sim/scenario.h"

namespace kobuki_sim {

/// The way from one stop to the next.
struct Leg {
  std::vector<Eigen::Vector2d> points;  // [m] from the first stop to the second, two points or more
  double length = 0.0;                  // [m]
};

/// The legs of a person in the order in which they are walked, and what follows the last.
struct Itinerary {
  std::vector<Leg> legs;     // empty: the person has nowhere to go
  int next_after_last = -1;  // leg that follows the last one; -1: the person stays
  bool jumps_back = false;   // after the last leg the person is put back at the first stop

  /// Leg after `leg`, -1 at the end.
  [[nodiscard]] int next(int leg) const;
};

using RouteFunction =
    std::function<std::vector<Eigen::Vector2d>(const Eigen::Vector2d&, const Eigen::Vector2d&)>;

/// Itinerary over the stops: the start position, then the waypoints.
/// loop: after the last waypoint on to the first (back to the start when there is only one); reverse: all
/// stops backwards to the start, then forwards again; respawn: put back at the start; stop: stays at the
/// last. `route` gives the points of a walkable way between two stops, both included.
[[nodiscard]] Itinerary makeItinerary(const Eigen::Vector2d& start,
                                      const std::vector<Eigen::Vector2d>& waypoints, OnArrival on_arrival,
                                      const RouteFunction& route);

/// A place on an itinerary at one time.
struct TimetablePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
};

/// Motion along an itinerary at constant `speed` [m/s], as a function of the time [s] since the departure
/// only.
[[nodiscard]] TimetablePoint timetablePoint(const Itinerary& itinerary, const Eigen::Vector2d& start,
                                            double speed, double time);

}  // namespace kobuki_sim
