// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/waiting_people.h"

#include <algorithm>

namespace sarn_navigation {
namespace {

/// Distance [m] from p to the segment between a and b.
double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double squared = way.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(way.dot(p - a) / squared, 0.0, 1.0) : 0.0;
  return (p - a - share * way).norm();
}

void stopBefore(const Eigen::Vector2d& robot, double distance, std::vector<sarn::PredictedState>& states) {
  if (states.empty()) return;
  const double allowed = std::min(distance, (states.front().position - robot).norm());
  for (std::size_t i = 1; i < states.size(); ++i) {
    const sarn::PredictedState& before = states[i - 1];
    if (distanceToSegment(robot, before.position, states[i].position) >= allowed) continue;
    sarn::PredictedState waiting = before;
    waiting.velocity.setZero();
    std::fill(states.begin() + static_cast<std::ptrdiff_t>(i), states.end(), waiting);
    return;
  }
}

}  // namespace

sarn::PeoplePrediction waitingInFrontOf(const Eigen::Vector2d& robot, double distance,
                                        sarn::PeoplePrediction people) {
  for (auto& person : people.people) stopBefore(robot, distance, person.states);
  return people;
}

}  // namespace sarn_navigation
