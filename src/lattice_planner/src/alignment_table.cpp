// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/alignment_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sarn_common/angles.h"

namespace lattice_planner {
namespace {

constexpr int kMaxSweeps = 300;

/// Index [0, count) of a heading, with its fraction.
double headingIndex(double heading, int count) {
  const double turns = heading / (2.0 * sarn::kPi);
  const double share = turns - static_cast<double>(static_cast<std::int64_t>(turns));
  const double index = (share < 0.0 ? share + 1.0 : share) * count;
  return index < count ? index : 0.0;
}

}  // namespace

AlignmentTable::AlignmentTable(const MotionLattice& lattice)
    : angular_speeds_(lattice.angularSpeeds()), speed_pairs_(lattice.speedPairs()) {
  values_.assign(static_cast<std::size_t>(kHeadings * speed_pairs_), 0.0F);
  float change = 1.0F;
  for (int sweep = 0; sweep < kMaxSweeps && change > 1e-4F; ++sweep) {
    change = 0.0F;
    for (int h = 0; h < kHeadings; ++h) {
      const double heading = 2.0 * sarn::kPi * h / kHeadings;
      for (int s = 0; s < speed_pairs_; ++s) {
        float best = std::numeric_limits<float>::infinity();
        for (const MotionPrimitive& p : lattice.from(s / angular_speeds_, s % angular_speeds_)) {
          const sarn::Pose2D& end = p.samples.back();
          const double progress = std::cos(heading) * end.x - std::sin(heading) * end.y;
          const double cost = static_cast<double>(p.base_cost) - lattice.costPerMetre() * progress;
          best =
              std::min(best, static_cast<float>(std::max(0.0, cost)) + at(heading + p.dtheta, p.v, p.omega));
        }
        float& value = values_[static_cast<std::size_t>(h * speed_pairs_ + s)];
        change = std::max(change, best - value);
        value = std::max(value, best);
      }
    }
  }
}

float AlignmentTable::at(double heading, int v, int omega) const {
  const double index = headingIndex(heading, kHeadings);
  const int low = static_cast<int>(index);
  const int high = low + 1 < kHeadings ? low + 1 : 0;
  const auto fraction = static_cast<float>(index - low);
  const int speeds = v * angular_speeds_ + omega;
  return (1.0F - fraction) * values_[static_cast<std::size_t>(low * speed_pairs_ + speeds)] +
         fraction * values_[static_cast<std::size_t>(high * speed_pairs_ + speeds)];
}

}  // namespace lattice_planner
