// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/walking_filter.h"

#include <algorithm>
#include <cmath>

namespace sarn_perception {
namespace {

constexpr double kLeastShare = 1e-3;  // of a model, so that it can come back

/// Mean and covariance of two normal distributions mixed in shares.
PersonFilter mixture(const std::array<PersonFilter, 2>& filters, const std::array<double, 2>& shares) {
  PersonFilter::State mean = PersonFilter::State::Zero();
  for (std::size_t i = 0; i < 2; ++i) mean += shares[i] * filters[i].state();
  PersonFilter::Covariance covariance = PersonFilter::Covariance::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const PersonFilter::State apart = filters[i].state() - mean;
    covariance += shares[i] * (filters[i].fullCovariance() + apart * apart.transpose());
  }
  return {mean, covariance, filters[0].gait()};
}

}  // namespace

WalkingFilter::WalkingFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma,
                             const GaitModel& gait)
    : filters_{PersonFilter(position, position_sigma, speed_sigma, gait),
               PersonFilter(position, position_sigma, speed_sigma, gait)},
      mixed_(filters_[kSteady]),
      measured_(mixed_) {}

void WalkingFilter::mix(double dt, const WalkingModel& model) {
  // Probabilities of a switch within dt, of a Markov chain in continuous time.
  const std::array<double, 2> leave{1.0 - std::exp(-dt / model.steady_time),
                                    1.0 - std::exp(-dt / model.changing_time)};
  const auto transition = [&](std::size_t from, std::size_t to) {
    return from == to ? 1.0 - leave[from] : leave[from];
  };
  const std::array<PersonFilter, 2> before = filters_;
  std::array<double, 2> predicted{};
  for (std::size_t to = 0; to < 2; ++to) {
    for (std::size_t from = 0; from < 2; ++from) predicted[to] += transition(from, to) * share_[from];
    std::array<double, 2> origin{};
    for (std::size_t from = 0; from < 2; ++from) {
      origin[from] = transition(from, to) * share_[from] / predicted[to];
    }
    filters_[to] = mixture(before, origin);
  }
  share_ = predicted;
}

void WalkingFilter::predict(double dt, const WalkingModel& model) {
  if (!(dt > 0.0)) return;
  mix(dt, model);
  filters_[kSteady].predict(dt, model.steady_density);
  filters_[kChanging].predict(dt, model.changing_density);
  unseen_ += dt;
  changes_ = true;
  combine();
}

void WalkingFilter::takeBackChanges(double density) {
  if (!changes_) return;
  measured_.predict(unseen_, density);
  filters_.fill(measured_);
  changes_ = false;
}

void WalkingFilter::predict(double dt, double density) {
  takeBackChanges(density);
  unseen_ += dt;
  for (PersonFilter& filter : filters_) filter.predict(dt, density);
  combine();
}

void WalkingFilter::rest(double dt, double wander) {
  for (PersonFilter& filter : filters_) filter.rest(dt, wander);
  unseen_ += dt;
  changes_ = false;
  combine();
}

void WalkingFilter::update(const PersonMeasurement& measured) {
  const std::array<double, 2> cost{filters_[kSteady].cost(measured), filters_[kChanging].cost(measured)};
  const double least = std::min(cost[kSteady], cost[kChanging]);
  std::array<double, 2> weight{};
  for (std::size_t i = 0; i < 2; ++i) {
    weight[i] = share_[i] * std::exp(-0.5 * (cost[i] - least));
    filters_[i].update(measured);
    filters_[i].limitSpeed();
  }
  const double total = weight[kSteady] + weight[kChanging];
  share_[kSteady] = std::clamp(weight[kSteady] / total, kLeastShare, 1.0 - kLeastShare);
  share_[kChanging] = 1.0 - share_[kSteady];
  combine();
  measured_ = mixed_;
  unseen_ = 0.0;
  changes_ = false;
}

void WalkingFilter::updateLegs(const std::vector<Leg>& legs, double age) {
  const PersonMeasurement one_way = legsAt(legs, 1.0, age);
  const PersonMeasurement other_way = legsAt(legs, -1.0, age);
  update(mixed_.cost(one_way) <= mixed_.cost(other_way) ? one_way : other_way);
}

void WalkingFilter::halt() {
  for (PersonFilter& filter : filters_) filter.halt();
  measured_.halt();
  combine();
}

void WalkingFilter::combine() { mixed_ = mixture(filters_, share_); }

}  // namespace sarn_perception
