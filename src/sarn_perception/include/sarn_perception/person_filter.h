// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace sarn_perception {

/// Kalman filter of a person who walks at nearly constant velocity: white acceleration of power q
/// (Bar-Shalom, Li and Kirubarajan 2001, *Estimation with Applications to Tracking and Navigation*,
/// eq. 6.2.2-4). State (x, y, vx, vy) in a frame that does not move with the robot.
class PersonFilter {
 public:
  /// At a measured position [m] with its standard deviation [m], at rest up to `speed_sigma` [m/s] an axis.
  PersonFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma);

  PersonFilter(const Eigen::Vector4d& state, const Eigen::Matrix4d& covariance)
      : state_(state), covariance_(covariance) {}

  /// Goes `dt` [s] >= 0 ahead; `density` [m^2/s^3] is q.
  void predict(double dt, double density);
  /// Takes in the position [m] that the person had `age` [s] >= 0 ago, with standard deviation `sigma` [m] on
  /// each axis: z = p - age v. (What the noise did in between is left out: ages are fractions of a second.)
  void update(const Eigen::Vector2d& position, double sigma, double age);
  /// Covariance of z - (p - age v) [m^2] for a position measured with standard deviation `sigma` [m].
  [[nodiscard]] Eigen::Matrix2d innovationCovariance(double sigma, double age) const;
  /// Where the person was `age` [s] ago [m].
  [[nodiscard]] Eigen::Vector2d positionBefore(double age) const { return position() - age * velocity(); }

  [[nodiscard]] Eigen::Vector2d position() const { return state_.head<2>(); }  // [m]
  [[nodiscard]] Eigen::Vector2d velocity() const { return state_.tail<2>(); }  // [m/s]
  [[nodiscard]] const Eigen::Vector4d& state() const { return state_; }
  [[nodiscard]] const Eigen::Matrix4d& covariance() const { return covariance_; }
  /// Standard deviation [m] of the position along its least certain direction.
  [[nodiscard]] double positionSigma() const;
  /// The person stands: after walking into a wall.
  void halt();
  /// Goes `dt` [s] ahead, of somebody who stands: at rest, `wander` [m^2/s] the growth of the variance of the
  /// place on each axis.
  void rest(double dt, double wander);

 private:
  Eigen::Vector4d state_;
  Eigen::Matrix4d covariance_;
};

}  // namespace sarn_perception
