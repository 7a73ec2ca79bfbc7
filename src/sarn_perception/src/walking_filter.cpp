// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/walking_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace sarn_perception {
namespace {

constexpr double kLeastShare = 1e-3;  // of a model, so that it can come back

/// Mean and covariance of two normal distributions mixed in shares.
PersonFilter mixture(const std::array<PersonFilter, 2>& filters, const std::array<double, 2>& shares) {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < 2; ++i) mean += shares[i] * filters[i].state();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector4d apart = filters[i].state() - mean;
    covariance += shares[i] * (filters[i].covariance() + apart * apart.transpose());
  }
  return {mean, covariance};
}

/// Density of what was measured, by a filter's prediction.
double likelihood(const PersonFilter& filter, const Eigen::Vector2d& position, double sigma, double age) {
  const Eigen::Matrix2d covariance = filter.innovationCovariance(sigma, age);
  const Eigen::Vector2d innovation = position - filter.positionBefore(age);
  return std::exp(-0.5 * innovation.dot(covariance.inverse() * innovation)) /
         std::sqrt(covariance.determinant());
}

}  // namespace

WalkingFilter::WalkingFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma)
    : filters_{PersonFilter(position, position_sigma, speed_sigma),
               PersonFilter(position, position_sigma, speed_sigma)},
      mixed_(filters_[kSteady]) {}

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
  combine();
}

void WalkingFilter::predict(double dt, double density) {
  for (PersonFilter& filter : filters_) filter.predict(dt, density);
  combine();
}

void WalkingFilter::rest(double dt, double wander) {
  for (PersonFilter& filter : filters_) filter.rest(dt, wander);
  combine();
}

void WalkingFilter::update(const Eigen::Vector2d& position, double sigma, double age) {
  std::array<double, 2> weight{};
  for (std::size_t i = 0; i < 2; ++i) {
    weight[i] = share_[i] * likelihood(filters_[i], position, sigma, age);
    filters_[i].update(position, sigma, age);
  }
  const double total = weight[kSteady] + weight[kChanging];
  // Both may say "impossible": then nothing is learned about which of them is right.
  if (total > 0.0) {
    share_[kSteady] = std::clamp(weight[kSteady] / total, kLeastShare, 1.0 - kLeastShare);
    share_[kChanging] = 1.0 - share_[kSteady];
  }
  combine();
}

void WalkingFilter::halt() {
  for (PersonFilter& filter : filters_) filter.halt();
  combine();
}

void WalkingFilter::combine() { mixed_ = mixture(filters_, share_); }

}  // namespace sarn_perception
