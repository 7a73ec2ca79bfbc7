// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/timed_trajectory.h"

#include <algorithm>
#include <cmath>

namespace sarn {

TrajectoryPoint TimedTrajectory::sample(double t) const {
  if (t <= points.front().t) return points.front();
  if (t >= points.back().t) {
    TrajectoryPoint end = points.back();
    end.v = end.omega = 0.0;
    end.t = t;
    return end;
  }
  const auto next =
      std::upper_bound(points.begin(), points.end(), t,
                       [](double time, const TrajectoryPoint& point) { return time < point.t; });
  const TrajectoryPoint& a = *(next - 1);
  const TrajectoryPoint& b = *next;
  const double ratio = (t - a.t) / (b.t - a.t);
  const Twist2D mean{0.5 * (a.v + b.v), 0.5 * (a.omega + b.omega)};
  const Pose2D pose = advance(a.pose(), mean, t - a.t);
  return {pose.x, pose.y, pose.theta, a.v + ratio * (b.v - a.v), a.omega + ratio * (b.omega - a.omega), t};
}

double TimedTrajectory::length() const {
  double total = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    total += std::abs(0.5 * (points[i - 1].v + points[i].v)) * (points[i].t - points[i - 1].t);
  }
  return total;
}

}  // namespace sarn
