// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/waiting_people.h"

#include <algorithm>

#include "sarn_common/segments.h"

namespace sarn_navigation {
namespace {

void stopBefore(const Eigen::Vector2d& robot, double distance, std::vector<sarn::PredictedState>& states) {
  if (states.empty()) return;
  const double allowed = std::min(distance, (states.front().position - robot).norm());
  for (std::size_t i = 1; i < states.size(); ++i) {
    const sarn::PredictedState& before = states[i - 1];
    if (sarn::distanceToSegment(robot, before.position, states[i].position) >= allowed) continue;
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
