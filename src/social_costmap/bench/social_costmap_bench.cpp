// SPDX-License-Identifier: BSD-3-Clause
// Prints one line of JSON: medians over many updates with moving people.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "social_costmap/social_layers.h"

namespace {

constexpr int kUpdates = 300;

double medianMs(const std::function<void(int)>& run) {
  std::vector<double> times;
  for (int i = 0; i < kUpdates; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    run(i);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::nth_element(times.begin(), times.begin() + kUpdates / 2, times.end());
  return times[kUpdates / 2];
}

struct Crowd {
  std::vector<Eigen::Vector2d> position;
  std::vector<Eigen::Vector2d> velocity;
  std::vector<std::string> group;
};

Crowd makeCrowd(int count, double size, int group_size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, size);
  std::uniform_real_distribution<double> speed(-0.9, 0.9);
  Crowd crowd;
  for (int i = 0; i < count; ++i) {
    crowd.position.emplace_back(place(random), place(random));
    crowd.velocity.emplace_back(speed(random), speed(random));
    crowd.group.push_back(group_size > 0 ? "group" + std::to_string(i / group_size) : "");
    if (group_size > 0 && i % group_size > 0) {  // beside the one before
      crowd.velocity.back() = crowd.velocity[crowd.velocity.size() - 2];
      crowd.position.back() = crowd.position[crowd.position.size() - 2] + Eigen::Vector2d(0.8, 0.0);
    }
  }
  return crowd;
}

// Constant velocity with growing sigma from `now` on, as the predictor sends it.
void predict(const Crowd& crowd, double now, int steps, sarn::PeoplePrediction& prediction) {
  prediction.stamp = now;
  prediction.time_step = 0.5;
  prediction.people.resize(crowd.position.size());
  for (std::size_t i = 0; i < crowd.position.size(); ++i) {
    auto& person = prediction.people[i];
    person.name = "p" + std::to_string(i);
    person.group = crowd.group[i];
    person.states.resize(static_cast<std::size_t>(steps));
    for (int k = 0; k < steps; ++k) {
      person.states[static_cast<std::size_t>(k)] = {crowd.position[i] + (now + 0.5 * k) * crowd.velocity[i],
                                                    crowd.velocity[i], 0.05 + 0.05 * k};
    }
  }
}

double socialUpdateMs(int people, int group_size, int cells, int num_layers = 30) {
  social_costmap::SocialParams params;
  params.num_layers = num_layers;
  social_costmap::SocialLayers layers(params);
  layers.resize({cells, cells, 0.05, 0.0, 0.0});
  const Crowd crowd = makeCrowd(people, cells * 0.05, group_size, 1);
  std::vector<sarn::PeoplePrediction> predictions(kUpdates);
  for (int i = 0; i < kUpdates; ++i) predict(crowd, 0.01 * i, 31, predictions[static_cast<std::size_t>(i)]);
  return medianMs([&](int i) { layers.update(predictions[static_cast<std::size_t>(i)], 0.01 * i); });
}

}  // namespace

int main() {
  std::printf(
      "{\"social_layers.update_ms\": %.3f, \"social_layers.update_ms.groups_of_4\": %.3f, "
      "\"social_layers.update_ms.200_people\": %.3f, \"planner.ancestor.layer_update_ms\": %.3f}\n",
      socialUpdateMs(20, 0, 200), socialUpdateMs(20, 4, 200), socialUpdateMs(200, 0, 200),
      socialUpdateMs(2, 0, 400, 15));  // as the ancestor: two people, 15 layers
  return 0;
}
