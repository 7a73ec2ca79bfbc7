// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/training_world.h"
#include "kobuki_sim/worker_pool.h"

namespace kobuki_sim {

/// N training worlds of at most P people each, stepped together by several threads. Worlds do not know of
/// each other: the results are those of single worlds, whatever the number of threads. Arrays are row-major.
class WorldBatch {
 public:
  static constexpr std::size_t kRobotColumns =
      9;  // px, py, vx, vy, radius, goal x, goal y, preferred speed, theta
  static constexpr std::size_t kPersonColumns = 5;  // px, py, vx, vy, radius

  WorldBatch(std::size_t worlds, std::size_t max_people, const TrainingParams& params, int threads);

  [[nodiscard]] std::size_t size() const { return worlds_.size(); }
  [[nodiscard]] std::size_t maxPeople() const { return max_people_; }
  [[nodiscard]] const TrainingParams& params() const { return params_; }
  [[nodiscard]] TrainingWorld& world(std::size_t i) { return worlds_.at(i); }
  [[nodiscard]] const TrainingWorld& world(std::size_t i) const { return worlds_.at(i); }

  /// `actions` (N, 2), all finite. Outcomes of world i are at place i.
  void step(const double* actions, std::vector<TrainingOutcome>& outcomes);

  /// (N, 9)
  void robots(double* out) const;
  /// (N, P, 5); rows of people who are not there are zero.
  void people(double* out) const;
  /// (N, P, 5): where people will be after the next step, without stepping.
  void nextPeople(double* out);
  /// (N, 2): the velocities [m/s] that ORCA gives the robots.
  void robotOrcaVelocities(double* out);

 private:
  void writePeople(std::size_t i, double ahead, const std::vector<Eigen::Vector2d>* velocities,
                   double* out) const;

  TrainingParams params_;
  std::size_t max_people_;
  std::vector<TrainingWorld> worlds_;
  WorkerPool pool_;
};

}  // namespace kobuki_sim
