// SPDX-License-Identifier: BSD-3-Clause
// Prints one JSON line: the median time of a 640x480 frame [ms] in a furnished room with eight people.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "kobuki_sim/depth_camera.h"
#include "sarn_common/angles.h"

namespace {

/// A 12 m x 9 m room at 0.05 m with an inner wall and pillars.
kobuki_sim::StaticMap room() {
  sarn::OccupancyMap map({240, 180, 0.05, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 240; ++x) {
      const bool outer = x < 2 || y < 2 || x > 237 || y > 177;
      const bool inner = x > 118 && x < 122 && (y < 70 || y > 90);
      const bool pillar = (x % 60) > 30 && (x % 60) < 38 && (y % 60) > 40 && (y % 60) < 48;
      if (outer || inner || pillar) map.at({x, y}) = sarn::kMapOccupied;
    }
  }
  return kobuki_sim::StaticMap(std::move(map));
}

std::vector<kobuki_sim::PersonState> crowd() {
  std::vector<kobuki_sim::PersonState> people(8);
  for (std::size_t i = 0; i < people.size(); ++i) {
    const auto k = static_cast<double>(i);
    people[i].position = {2.0 + 0.9 * k, 3.2 + 1.9 * std::sin(2.0 * k)};
    people[i].heading = 0.8 * k;
    people[i].velocity = {std::cos(people[i].heading), std::sin(people[i].heading)};
    people[i].walking_phase = k;
  }
  return people;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(1, std::stoi(argv[1])) : 500;
  const kobuki_sim::StaticMap map = room();
  const auto people = crowd();
  kobuki_sim::DepthCamera camera({}, 1);
  std::vector<double> times;
  std::size_t returns = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const sarn::Pose2D base{1.0, 4.0, 0.4 * std::sin(2.0 * sarn::kPi * frame / frames)};
    const auto start = std::chrono::steady_clock::now();
    const auto& image = camera.render(map, base, people, static_cast<std::uint64_t>(frame));
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    times.push_back(elapsed.count());
    returns += static_cast<std::size_t>(std::count_if(image.millimetres.begin(), image.millimetres.end(),
                                                      [](std::uint16_t d) { return d != 0; }));
  }
  std::nth_element(times.begin(), times.begin() + frames / 2, times.end());
  const double pixels = 640.0 * 480.0 * frames;
  std::printf("{\"depth.frame_ms\": %.4f}\n", times[static_cast<std::size_t>(frames) / 2]);
  std::fprintf(stderr, "%.1f %% of the pixels have a depth\n", 100.0 * static_cast<double>(returns) / pixels);
  return 0;
}
