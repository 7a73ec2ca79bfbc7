// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/people.h"
#include "social_costmap/person_space.h"

namespace social_costmap {

/// Farthest coordinate [m] that is taken for a person's position; anything else is a broken input.
inline constexpr double kMaxCoordinate = 1e6;

/// Number of leading states of a prediction that are finite and within kMaxCoordinate.
[[nodiscard]] std::size_t usableStates(const sarn::PersonPrediction& person);

/// A person's predicted way in continuous time: linear between states, constant velocity with growing sigma
/// after the last, heading interpolated along the shorter way round. Refers to the prediction, which must
/// outlive it.
class PersonPath {
 public:
  /// `usable` > 0 states count. stamp [s] of the first state, time_step [s] > 0 between states.
  PersonPath(const sarn::PersonPrediction& person, std::size_t usable, double stamp, double time_step,
             const SocialParams& params);

  [[nodiscard]] PersonState at(double time) const;
  /// States from `begin` to `end` [s] such that straight pieces between neighbours with the mean heading
  /// follow the way to within `tolerance` [m]; appended to `states`, at least two.
  void sample(double begin, double end, double tolerance, std::vector<PersonState>& states) const;

 private:
  [[nodiscard]] PersonState stateAt(std::size_t index) const;
  /// State `duration` [s] after (before, when negative) a predicted one, at its velocity.
  [[nodiscard]] PersonState extrapolated(std::size_t index, double duration) const;
  void appendPieces(const PersonState& to, double tolerance, std::vector<PersonState>& states) const;

  const sarn::PersonPrediction* person_;
  std::size_t usable_;
  double stamp_;
  double time_step_;
  double standing_speed_;
  double sigma_rate_;  // [m/s] after the last state
};

}  // namespace social_costmap
