// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/gait.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace kobuki_sim {

double stepLength(double speed) { return std::max(0.15, 0.7 * std::sqrt(speed / 1.3)); }

double advancePhase(double phase, double distance, double speed) {
  const double cycle = 2.0 * sarn::kPi;
  const double advanced = phase + cycle * distance / (2.0 * stepLength(speed));
  return advanced < cycle ? advanced : std::fmod(advanced, cycle);
}

}  // namespace kobuki_sim
