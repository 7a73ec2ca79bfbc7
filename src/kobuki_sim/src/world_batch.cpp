// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/world_batch.h"

#include <algorithm>

namespace kobuki_sim {

WorldBatch::WorldBatch(std::size_t worlds, std::size_t max_people, const TrainingParams& params, int threads)
    : params_(params), max_people_(max_people), worlds_(worlds, TrainingWorld(params)), pool_(threads) {}

void WorldBatch::step(const double* actions, std::vector<TrainingOutcome>& outcomes) {
  outcomes.resize(worlds_.size());
  pool_.run(worlds_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      outcomes[i] = worlds_[i].step({actions[2 * i], actions[2 * i + 1]});
    }
  });
}

void WorldBatch::robots(double* out) const {
  for (const TrainingWorld& world : worlds_) {
    const TrainingAgent& robot = world.robot();
    const double row[kRobotColumns] = {
        robot.disc.position.x(), robot.disc.position.y(), robot.disc.velocity.x(),
        robot.disc.velocity.y(), robot.disc.radius,       robot.goal.x(),
        robot.goal.y(),          robot.preferred_speed,   world.theta()};
    out = std::copy(std::begin(row), std::end(row), out);
  }
}

void WorldBatch::writePeople(std::size_t i, double ahead, const std::vector<Eigen::Vector2d>* velocities,
                             double* out) const {
  const std::vector<TrainingAgent>& people = worlds_[i].people();
  double* row = out + i * max_people_ * kPersonColumns;
  double* const row_end = row + max_people_ * kPersonColumns;
  for (std::size_t k = 0; k < people.size(); ++k, row += kPersonColumns) {
    const Eigen::Vector2d& velocity = velocities != nullptr ? (*velocities)[k] : people[k].disc.velocity;
    const Eigen::Vector2d position = people[k].disc.position + ahead * velocity;
    row[0] = position.x();
    row[1] = position.y();
    row[2] = velocity.x();
    row[3] = velocity.y();
    row[4] = people[k].disc.radius;
  }
  std::fill(row, row_end, 0.0);
}

void WorldBatch::people(double* out) const {
  for (std::size_t i = 0; i < worlds_.size(); ++i) writePeople(i, 0.0, nullptr, out);
}

void WorldBatch::nextPeople(double* out) {
  pool_.run(worlds_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      writePeople(i, params_.time_step, &worlds_[i].nextPeopleVelocities(), out);
    }
  });
}

void WorldBatch::robotOrcaVelocities(double* out) {
  pool_.run(worlds_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector2d velocity = worlds_[i].robotOrcaVelocity();
      out[2 * i] = velocity.x();
      out[2 * i + 1] = velocity.y();
    }
  });
}

}  // namespace kobuki_sim
