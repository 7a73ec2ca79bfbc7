// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/robot_disc.h"
#include "kobuki_sim/scenario.h"
#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// All people of a scenario. They decide every decision period and are moved every step; nobody enters a
/// wall.
class Crowd {
 public:
  /// `scenario` has its jitter drawn already; `map` may be null (open space), is not owned and outlives the
  /// crowd.
  Crowd(const Scenario& scenario, const StaticMap* map, std::uint64_t seed);

  /// Advances everyone by dt [s] > 0. `robot` is the robot at the beginning of the step.
  void step(double dt, const RobotDisc& robot);
  [[nodiscard]] const std::vector<PersonState>& people() const { return people_; }

 private:
  std::vector<PersonState> people_;
};

}  // namespace kobuki_sim
