// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/commit.h"

#include <cmath>
#include <stdexcept>

#include "sarn_common/angles.h"

namespace lattice_planner {
namespace {

constexpr double kSameTime = 1e-6;  // [s]

bool same(const sarn::TrajectoryPoint& a, const sarn::TrajectoryPoint& b) {
  constexpr double kTolerance = 1e-3;
  return std::abs(a.x - b.x) < kTolerance && std::abs(a.y - b.y) < kTolerance &&
         std::abs(sarn::angleDifference(a.theta, b.theta)) < kTolerance && std::abs(a.v - b.v) < kTolerance &&
         std::abs(a.omega - b.omega) < kTolerance && std::abs(a.t - b.t) < kTolerance;
}

}  // namespace

sarn::TimedTrajectory commit(const sarn::TimedTrajectory& previous, double now, double release_time) {
  sarn::TimedTrajectory committed;
  if (previous.empty() || previous.endTime() < now - kSameTime) return committed;
  const auto& points = previous.points;
  std::size_t first = 0;
  while (first + 1 < points.size() && points[first + 1].t <= now + kSameTime) ++first;
  for (std::size_t i = first; i < points.size(); ++i) {
    committed.points.push_back(points[i]);
    if (points[i].t >= release_time - kSameTime) return committed;
  }
  committed.points.push_back(previous.sample(release_time));
  return committed;
}

sarn::TimedTrajectory commit(const sarn::TimedTrajectory& previous, double release_time) {
  return previous.empty() ? sarn::TimedTrajectory{} : commit(previous, previous.startTime(), release_time);
}

sarn::TimedTrajectory join(const sarn::TimedTrajectory& committed, const sarn::TimedTrajectory& planned) {
  if (committed.empty()) return planned;
  if (planned.empty()) return committed;
  if (!same(committed.points.back(), planned.points.front())) {
    throw std::invalid_argument("join: the planned trajectory does not start where the committed one ends");
  }
  sarn::TimedTrajectory joined = committed;
  joined.points.insert(joined.points.end(), planned.points.begin() + 1, planned.points.end());
  return joined;
}

}  // namespace lattice_planner
