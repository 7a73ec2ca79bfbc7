// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sarn_perception/person_filter.h"

namespace sarn_perception {

/// How somebody who is seen moves on: steadily, or starting, stopping and turning.
struct WalkingModel {
  double steady_density = 0.1;     // [m^2/s^3] power of white acceleration
  double changing_density = 10.0;  // [m^2/s^3]
  double steady_time = 2.0;        // [s] mean time of steady walking
  double changing_time = 0.3;      // [s] mean time of a change
};

/// Two filters of constant velocity side by side, one for steady walking and one for changes, mixed by how
/// well each explains what is measured: the interacting multiple model estimator (Blom and Bar-Shalom 1988,
/// "The Interacting Multiple Model Algorithm for Systems with Markovian Switching Coefficients"). So that a
/// steady person's velocity is smooth, and one who turns back is followed within a few measurements.
class WalkingFilter {
 public:
  /// At a measured position [m] with its standard deviation [m], at rest up to `speed_sigma` [m/s] an axis.
  WalkingFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma,
                const GaitModel& gait = {});

  /// Goes `dt` [s] >= 0 ahead, of somebody who is seen.
  void predict(double dt, const WalkingModel& model);
  /// Goes `dt` [s] >= 0 ahead, of somebody who is not seen; `density` [m^2/s^3]. From the last measurement
  /// on: what the model of changes allowed since then is taken back, as it holds for moments only.
  void predict(double dt, double density);
  /// Goes `dt` [s] >= 0 ahead, of somebody who stands unseen; as PersonFilter's.
  void rest(double dt, double wander);
  /// As PersonFilter's.
  void update(const Eigen::Vector2d& position, double sigma, double age) {
    update(middleAt(position, sigma, age));
  }
  /// Takes in one or two legs that were seen `age` [s] >= 0 ago, as the sides they most likely are.
  void updateLegs(const std::vector<Leg>& legs, double age);
  [[nodiscard]] Eigen::Matrix2d innovationCovariance(double sigma, double age) const {
    return mixed_.innovationCovariance(sigma, age);
  }
  [[nodiscard]] Eigen::Vector2d positionBefore(double age) const { return mixed_.positionBefore(age); }
  [[nodiscard]] Eigen::Vector2d position() const { return mixed_.position(); }  // [m]
  [[nodiscard]] Eigen::Vector2d velocity() const { return mixed_.velocity(); }  // [m/s]
  /// Of position and velocity.
  [[nodiscard]] Eigen::Matrix4d covariance() const { return mixed_.covariance(); }
  [[nodiscard]] double positionSigma() const { return mixed_.positionSigma(); }
  void halt();

  /// Probability that the person is changing its velocity just now.
  [[nodiscard]] double changing() const { return share_[kChanging]; }

 private:
  static constexpr std::size_t kSteady = 0;
  static constexpr std::size_t kChanging = 1;

  void update(const PersonMeasurement& measured);
  void mix(double dt, const WalkingModel& model);
  void combine();
  /// Back to what was known when last measured, and from there on with `density`.
  void takeBackChanges(double density);

  std::array<PersonFilter, 2> filters_;
  std::array<double, 2> share_{0.5, 0.5};  // probabilities of the two
  PersonFilter mixed_;                     // what both say together
  PersonFilter measured_;                  // the same, just after the last measurement
  double unseen_ = 0.0;                    // [s] since then
  bool changes_ = false;                   // both models have gone on since then
};

}  // namespace sarn_perception
