// SPDX-License-Identifier: BSD-3-Clause
#include "time_axis.h"

#include <algorithm>
#include <cstring>

namespace lattice_planner {
namespace {

constexpr std::uint32_t kLongestTimeAxis = 2000;  // [time steps]

}  // namespace

void TimeAxis::reset(const PlannerParams& params, const MotionLattice& lattice, double start,
                     sarn::TimedCostmapView& costmap) {
  if (params.forget_moving_people) appendLayerAfterHorizon(costmap);
  last_layer_ = static_cast<int>(costmap.layers.size()) - 1;
  samples_ = static_cast<std::size_t>(lattice.samplesPerStep());
  layer_of_sample_.clear();
  merge_step_ = 0;
  const int first_of_last = firstOfTheLast(costmap);
  if (first_of_last <= 0) return;
  const double changes_until = costmap.first_layer_time + first_of_last * costmap.layer_duration;
  const int samples = lattice.samplesPerStep();
  const auto time = [&](std::uint32_t step, int sample) {
    return start + (step + static_cast<double>(sample + 1) / samples) * params.time_step;
  };
  while (merge_step_ < kLongestTimeAxis && time(merge_step_, -1) < changes_until) {
    for (int k = -1; k < samples; ++k) layer_of_sample_.push_back(costmap.layerAt(time(merge_step_, k)));
    ++merge_step_;
  }
}

/// What the first, the middle and the last layer agree on: those who stood still.
void TimeAxis::appendLayerAfterHorizon(sarn::TimedCostmapView& costmap) {
  const std::size_t count = costmap.layers.size();
  if (count < 2) return;
  const std::size_t size = costmap.geometry.size();
  const std::uint8_t* const first = costmap.layers.front();
  const std::uint8_t* const middle = costmap.layers[count / 2];
  const std::uint8_t* const last = costmap.layers.back();
  after_horizon_.resize(size);
  for (std::size_t i = 0; i < size; ++i) after_horizon_[i] = std::min(std::min(first[i], middle[i]), last[i]);
  costmap.layers.push_back(after_horizon_.data());
}

/// Equal layers at the end count as one: standing people do not keep states apart by time.
int TimeAxis::firstOfTheLast(const sarn::TimedCostmapView& costmap) const {
  int first = last_layer_;
  while (first > 0) {
    const std::uint8_t* a = costmap.layers[static_cast<std::size_t>(first - 1)];
    const std::uint8_t* b = costmap.layers[static_cast<std::size_t>(last_layer_)];
    if (a != b && std::memcmp(a, b, costmap.geometry.size()) != 0) break;
    --first;
  }
  return first;
}

}  // namespace lattice_planner
