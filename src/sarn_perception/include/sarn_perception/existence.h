// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace sarn_perception {

// Probability that a track is a person (integrated probabilistic data association: Musicki, Evans and
// Stankovic 1994, "Integrated Probabilistic Data Association", for one measurement a track).

/// After a detection that is `ratio` > 0 times as likely with a person there as without.
[[nodiscard]] inline double existenceAfterDetection(double existence, double ratio) {
  return existence * ratio / (1.0 - existence + existence * ratio);
}

/// After a look that would have detected a person with `probability` [0, 1) and did not.
[[nodiscard]] inline double existenceAfterMiss(double existence, double probability) {
  return existence * (1.0 - probability) / (1.0 - existence * probability);
}

/// Probability of at least one detection in `dt` [s], when it is `probability` in `time` [s] and looks that
/// follow each other quickly fail together: the same evidence a second at any frame rate.
[[nodiscard]] inline double detectionWithin(double dt, double probability, double time) {
  return 1.0 - std::pow(1.0 - probability, dt / time);
}

}  // namespace sarn_perception
