// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sarn {

/// A person as perception sees it, in one frame that the owner names.
struct Person {
  std::string name;
  std::string group;                                   // people of one group share this name; empty: alone
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double reliability = 1.0;                            // [0, 1]
};

/// Where a person is expected at one time.
struct PredictedState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double sigma = 0.0;                                  // [m] standard deviation of the position on any axis
};

struct PersonPrediction {
  std::string name;
  std::string group;
  std::vector<PredictedState> states;  // state i at stamp + i * time_step
};

/// Everyone over the coming time steps.
struct PeoplePrediction {
  double stamp = 0.0;      // [s] time of the first state
  double time_step = 0.5;  // [s] > 0
  std::vector<PersonPrediction> people;
};

}  // namespace sarn
