// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_perception/leg.h"
#include "sarn_perception/tracking_params.h"
#include "sarn_perception/walking_filter.h"

namespace sarn_perception {

/// Which legs belong to whom; indices.
struct LegShares {
  std::vector<std::vector<std::size_t>> of_person;  // at most two legs each
  std::vector<std::size_t> unclaimed;
};

/// -2 ln of the likelihood of a detection, up to a constant: squared Mahalanobis distance plus ln |S|
/// (Bar-Shalom, Li and Kirubarajan 2001). `gated`: the distance is beyond the gate, or the detection is
/// likelier that of a newcomer, N(z; S) < newcomer_density (the density of new targets of Reid 1979, "An
/// Algorithm for Tracking Multiple Targets"). Who was out of sight for long may be anywhere, and so nearly
/// everywhere: without the second rule they would take over whoever turns up.
struct Fit {
  double cost = 0.0;
  bool gated = true;
};
[[nodiscard]] Fit detectionFit(const WalkingFilter& person, const Eigen::Vector2d& position, double sigma,
                               double age, const TrackerParams& params);

/// Gives legs to people who are known already: each has room for two, and all together get what is most
/// likely (the joint view of a person's legs of Leigh, Pineau, Olmedo and Zhang 2015, "Person Tracking and
/// Following with 2D Laser Scanners"). So the next person's leg is not paired with mine when we walk side by
/// side. `age` [s] of the legs.
[[nodiscard]] LegShares shareLegs(const std::vector<const WalkingFilter*>& people,
                                  const std::vector<Leg>& legs, const std::vector<std::size_t>& available,
                                  double age, const TrackerParams& params);

/// Pairs of legs of people nobody knows yet, nearest ones first; who is left over stands alone.
[[nodiscard]] std::vector<std::vector<std::size_t>> pairLegs(const std::vector<Leg>& legs,
                                                             std::vector<std::size_t> unclaimed,
                                                             double max_separation);

}  // namespace sarn_perception
