// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/planner_params.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lattice_planner/footprint.h"

namespace lattice_planner {
namespace {

/// A limit that the lattice's speeds do not reach exactly would silently be a smaller one.
void checkMultiple(const char* limit, double value, const char* acceleration, double acc, double time_step,
                   std::vector<std::string>& conflicts) {
  const double steps = value / (acc * time_step);
  if (std::abs(steps - std::round(steps)) < 1e-6) return;
  std::ostringstream text;
  text << limit << ": " << value << " is not a multiple of " << acceleration
       << " * time_step = " << acc * time_step << "; the nearest is " << std::round(steps) * acc * time_step;
  conflicts.push_back(text.str());
}

}  // namespace

std::vector<std::string> PlannerParams::conflicts() const {
  std::vector<std::string> all;
  checkMultiple("min_vel_x", min_vel_x, "acc_lim_x", acc_lim_x, time_step, all);
  checkMultiple("max_vel_x", max_vel_x, "acc_lim_x", acc_lim_x, time_step, all);
  checkMultiple("max_vel_theta", max_vel_theta, "acc_lim_theta", acc_lim_theta, time_step, all);
  const double speeds = (max_vel_x - min_vel_x) / (acc_lim_x * time_step) + 1.0;
  if (!(speeds >= 1.5 && speeds < 31.5)) {
    all.emplace_back("max_vel_x: the lattice must have between 2 and 31 forward speeds");
  }
  const double turns = 2.0 * max_vel_theta / (acc_lim_theta * time_step) + 1.0;
  if (!(turns >= 2.5 && turns < 31.5)) {
    all.emplace_back("max_vel_theta: the lattice must have between 3 and 31 angular speeds");
  }
  try {
    (void)parseFootprint(footprint);
  } catch (const std::invalid_argument& error) {
    all.push_back("footprint: '" + footprint + "': " + error.what());
  }
  return all;
}

}  // namespace lattice_planner
