// SPDX-License-Identifier: BSD-3-Clause
// How fast the world runs on one core: prints one JSON object a line, {"name": ..., "value": ...}; medians of
// `repeats` runs (argument, default 5).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "kobuki_sim/world.h"

namespace {

using kobuki_sim::Scenario;
using kobuki_sim::World;

/// ORCA people on a lattice in open space, each walking to and fro through the crowd, so that they keep
/// meeting.
Scenario crowdOf(int people, double spacing) {
  Scenario scenario;
  scenario.robot_pose = {-2.0 * spacing, 0.0, 0.0};
  scenario.jitter = {0.3, 1.0, 0.2};
  const int side = static_cast<int>(std::ceil(std::sqrt(people)));
  const double middle = 0.5 * (side - 1) * spacing;
  for (int i = 0; i < people; ++i) {
    kobuki_sim::PersonSpec person;
    person.name = "person " + std::to_string(i);
    person.position = {(i % side) * spacing, (i / side) * spacing};
    const Eigen::Vector2d from_middle = person.position - Eigen::Vector2d(middle, middle);
    const double reach = std::max(3.0, from_middle.norm());
    const double angle = 2.399963 * i;  // golden angle: every direction
    person.waypoints = {person.position + reach * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
                        person.position};
    scenario.people.push_back(person);
  }
  return scenario;
}

/// Simulated seconds a second of wall time.
double realTimeFactor(const Scenario& scenario, double duration) {
  World world(scenario, nullptr, 1);
  for (int i = 0; i < 100; ++i) world.step();  // warm up
  const double begin = world.time();
  const auto start = std::chrono::steady_clock::now();
  while (world.time() < begin + duration) {
    if (world.steps() % 10 == 0) world.base().commandVelocity(0.3, 0.5 * std::sin(world.time()));
    world.step();
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return (world.time() - begin) / elapsed.count();
}

void report(const std::string& name, int repeats, int people, double spacing, double duration) {
  const Scenario scenario = crowdOf(people, spacing);
  std::vector<double> factors;
  for (int i = 0; i < repeats; ++i) factors.push_back(realTimeFactor(scenario, duration));
  std::sort(factors.begin(), factors.end());
  std::cout << "{\"name\": \"" << name << "\", \"value\": " << factors[factors.size() / 2] << "}"
            << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = std::max(1, argc > 1 ? std::atoi(argv[1]) : 5);
  report("world.realtime_factor.10_people", repeats, 10, 1.5, 120.0);
  report("world.realtime_factor.1000_people", repeats, 1000, 2.0, 5.0);
  return 0;
}
