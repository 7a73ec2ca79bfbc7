// SPDX-License-Identifier: BSD-3-Clause
// C face of the ORCA simulator for the comparison with another library (orca_oracle_test.py); not installed.
#include "kobuki_sim/people/orca_simulator.h"

namespace {

Eigen::Vector2d at(const double* xy, int i) { return {xy[2 * i], xy[2 * i + 1]}; }

}  // namespace

extern "C" {

/// New velocities of n agents. `agents` (n, 12): x, y, vx, vy, preferred vx, preferred vy, radius, max_speed,
/// neighbor_dist, max_neighbors, time_horizon, time_horizon_obst. `outline_points` holds the corners of all
/// outlines one after the other, `outline_sizes` how many each has. `velocities` (n, 2) is written.
void orca_velocities(int n, const double* agents, double time_step, int num_outlines,
                     const int* outline_sizes, const double* outline_points, double* velocities) {
  kobuki_sim::OrcaSimulator simulator(time_step);
  for (int i = 0; i < n; ++i) {
    const double* a = agents + 12 * i;
    kobuki_sim::OrcaAgent agent;
    agent.disc = {at(a, 0), at(a, 1), a[6]};
    agent.preferred_velocity = at(a, 2);
    agent.max_speed = a[7];
    agent.params = {a[8], static_cast<int>(a[9]), a[10], a[11]};
    simulator.addAgent(agent);
  }
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  for (int k = 0, first = 0; k < num_outlines; first += outline_sizes[k], ++k) {
    outlines.emplace_back();
    for (int i = 0; i < outline_sizes[k]; ++i) outlines.back().push_back(at(outline_points, first + i));
  }
  simulator.setOutlines(outlines);
  const auto& result = simulator.computeVelocities();
  for (int i = 0; i < n; ++i) {
    velocities[2 * i] = result[static_cast<std::size_t>(i)].x();
    velocities[2 * i + 1] = result[static_cast<std::size_t>(i)].y();
  }
}
}
