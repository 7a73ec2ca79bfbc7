// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn {

/// State (x, y, theta, v, omega, t) of a differential drive.
struct TrajectoryPoint {
  double x = 0.0;      // [m] planning frame
  double y = 0.0;      // [m]
  double theta = 0.0;  // [rad] (-pi, pi]
  double v = 0.0;      // [m/s] forward
  double omega = 0.0;  // [rad/s]
  double t = 0.0;      // [s] absolute time

  [[nodiscard]] Pose2D pose() const { return {x, y, theta}; }
};

/// Points in strictly increasing time. Between two points v and omega change linearly and the robot moves on
/// the arc of their means (the planner's motion model: one action is one constant arc with the mean of old
/// and new speeds).
struct TimedTrajectory {
  std::vector<TrajectoryPoint> points;

  [[nodiscard]] bool empty() const { return points.empty(); }
  [[nodiscard]] double startTime() const { return points.front().t; }  // [s]; not empty
  [[nodiscard]] double endTime() const { return points.back().t; }     // [s]; not empty
  /// State at time t [s]: the first point before the start, the last one, standing, after the end. Not empty.
  [[nodiscard]] TrajectoryPoint sample(double t) const;
  /// Length of the path [m].
  [[nodiscard]] double length() const;
};

}  // namespace sarn
