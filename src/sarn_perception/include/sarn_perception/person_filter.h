// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sarn_perception/leg.h"

namespace sarn_perception {

/// How far a leg is from the middle between both: about the same to each side, more and more along the way
/// the faster somebody walks, and hardly predictable for longer than a part of a step.
struct GaitModel {
  double stance_sigma = 0.09;  // [m] of a leg's offset on each axis
  double swing_time = 0.15;    // [s] times the speed: what comes to that along the way
  double settle_time = 0.4;    // [s] in which an offset that was seen is forgotten
  double max_speed = 2.0;      // [m/s] nobody is faster
};

/// Positions that depend on a person's state linearly: value = h state + noise.
struct PersonMeasurement {
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::ColMajor, 4, 6> h;
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1> value;     // [m]
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1> variance;  // [m^2]
};

/// The middle of a person was at a position [m] `age` [s] >= 0 ago, with standard deviation `sigma` [m] on
/// each axis: z = p - age v. (What the noise did in between is left out: ages are fractions of a second.)
[[nodiscard]] PersonMeasurement middleAt(const Eigen::Vector2d& position, double sigma, double age);
/// One or two legs were: z = p - age v + l for one of them and z = p - age v - l for the other. `first_side`
/// is 1 or -1: which of the two the first leg is.
[[nodiscard]] PersonMeasurement legsAt(const std::vector<Leg>& legs, double first_side, double age);

/// Kalman filter of a person who walks at nearly constant velocity: white acceleration of power q
/// (Bar-Shalom, Li and Kirubarajan 2001, *Estimation with Applications to Tracking and Navigation*,
/// eq. 6.2.2-4), on two legs that stand at equal distances from the middle, as those of walking people do
/// (Arras, Grzonka, Luber and Burgard 2008, "Efficient People Tracking in Laser Range Data using a
/// Multi-Hypothesis Leg-Tracker with Adaptive Occlusion Probabilities", track legs one by one). The offset is
/// a process of Ornstein and Uhlenbeck: its error is the same from scan to scan, which to take for white
/// noise would tell a velocity that nobody has. State (x, y, vx, vy, lx, ly) in a frame that does not move
/// with the robot; l from the middle to one of the legs.
class PersonFilter {
 public:
  using State = Eigen::Matrix<double, 6, 1>;
  using Covariance = Eigen::Matrix<double, 6, 6>;

  /// At a measured position [m] with its standard deviation [m], at rest up to `speed_sigma` [m/s] an axis.
  PersonFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma,
               const GaitModel& gait = {});

  PersonFilter(State state, Covariance covariance, const GaitModel& gait)
      : state_(std::move(state)), covariance_(std::move(covariance)), gait_(gait) {}

  /// Goes `dt` [s] >= 0 ahead; `density` [m^2/s^3] is q.
  void predict(double dt, double density);
  void update(const PersonMeasurement& measured);
  void update(const Eigen::Vector2d& position, double sigma, double age) {
    update(middleAt(position, sigma, age));
  }
  /// -2 ln of the density of what was measured, up to a constant.
  [[nodiscard]] double cost(const PersonMeasurement& measured) const;
  /// Covariance of z - (p - age v) [m^2] for a position measured with standard deviation `sigma` [m].
  [[nodiscard]] Eigen::Matrix2d innovationCovariance(double sigma, double age) const;
  /// Where the person was `age` [s] ago [m].
  [[nodiscard]] Eigen::Vector2d positionBefore(double age) const { return position() - age * velocity(); }

  [[nodiscard]] Eigen::Vector2d position() const { return state_.head<2>(); }      // [m]
  [[nodiscard]] Eigen::Vector2d velocity() const { return state_.segment<2>(2); }  // [m/s]
  [[nodiscard]] Eigen::Vector2d legOffset() const { return state_.tail<2>(); }     // [m]
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Covariance& fullCovariance() const { return covariance_; }
  [[nodiscard]] const GaitModel& gait() const { return gait_; }
  /// Of position and velocity.
  [[nodiscard]] Eigen::Matrix4d covariance() const { return covariance_.topLeftCorner<4, 4>(); }
  /// Standard deviation [m] of the position along its least certain direction.
  [[nodiscard]] double positionSigma() const;
  /// Nobody runs: a faster velocity, as after a mistaken identity, is cut to the gait's max_speed, the
  /// nearest one that is possible (Simon 2010, "Kalman Filtering with State Constraints").
  void limitSpeed();
  /// The person stands: after walking into a wall.
  void halt();
  /// Goes `dt` [s] ahead, of somebody who stands: at rest, `wander` [m^2/s] the growth of the variance of the
  /// place on each axis.
  void rest(double dt, double wander);

 private:
  void forgetLegs(double dt);

  State state_;
  Covariance covariance_;
  GaitModel gait_;
};

}  // namespace sarn_perception
