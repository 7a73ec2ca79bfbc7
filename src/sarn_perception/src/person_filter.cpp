// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/person_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace sarn_perception {
namespace {

constexpr double kWalking = 0.05;  // [m/s] slower people have no direction

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;

Square innovationCovariance(const PersonFilter::Covariance& covariance, const PersonMeasurement& measured) {
  Square s = measured.h * covariance * measured.h.transpose();
  s.diagonal() += measured.variance;
  return s;
}

/// One position, `side` times the legs' offset from the middle.
void setRows(Eigen::Index row, const Eigen::Vector2d& position, double sigma, double side, double age,
             PersonMeasurement& measured) {
  measured.h.middleRows<2>(row) << Eigen::Matrix2d::Identity(), -age * Eigen::Matrix2d::Identity(),
      side * Eigen::Matrix2d::Identity();
  measured.value.segment<2>(row) = position;
  measured.variance.segment<2>(row).setConstant(sigma * sigma);
}

PersonMeasurement ofSize(Eigen::Index rows) {
  PersonMeasurement measured;
  measured.h.resize(rows, 6);
  measured.value.resize(rows);
  measured.variance.resize(rows);
  return measured;
}

}  // namespace

PersonMeasurement middleAt(const Eigen::Vector2d& position, double sigma, double age) {
  PersonMeasurement measured = ofSize(2);
  setRows(0, position, sigma, 0.0, age, measured);
  return measured;
}

PersonMeasurement legsAt(const std::vector<Leg>& legs, double first_side, double age) {
  const std::size_t count = std::min<std::size_t>(legs.size(), 2);
  PersonMeasurement measured = ofSize(static_cast<Eigen::Index>(2 * count));
  for (std::size_t i = 0; i < count; ++i) {
    setRows(static_cast<Eigen::Index>(2 * i), legs[i].position, legs[i].sigma,
            i == 0 ? first_side : -first_side, age, measured);
  }
  return measured;
}

PersonFilter::PersonFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma,
                           const GaitModel& gait)
    : gait_(gait) {
  state_ << position, Eigen::Vector4d::Zero();
  const double p = position_sigma * position_sigma;
  const double v = speed_sigma * speed_sigma;
  const double l = gait.stance_sigma * gait.stance_sigma;
  covariance_ = (State() << p, p, v, v, l, l).finished().asDiagonal();
}

void PersonFilter::predict(double dt, double density) {
  Covariance f = Covariance::Identity();
  f.block<2, 2>(0, 2) = dt * Eigen::Matrix2d::Identity();
  Covariance q = Covariance::Zero();
  q.topLeftCorner<2, 2>().diagonal().setConstant(density * dt * dt * dt / 3.0);
  q.block<2, 2>(0, 2).diagonal().setConstant(density * dt * dt / 2.0);
  q.block<2, 2>(2, 0) = q.block<2, 2>(0, 2);
  q.block<2, 2>(2, 2).diagonal().setConstant(density * dt);
  state_ = f * state_;
  covariance_ = f * covariance_ * f.transpose() + q;
  forgetLegs(dt);
}

void PersonFilter::forgetLegs(double dt) {
  const double keep = std::exp(-dt / gait_.settle_time);
  State factor = State::Ones();
  factor.tail<2>().setConstant(keep);
  state_ = factor.cwiseProduct(state_);
  covariance_ = factor.asDiagonal() * covariance_ * factor.asDiagonal();
  Eigen::Matrix2d spread = gait_.stance_sigma * gait_.stance_sigma * Eigen::Matrix2d::Identity();
  const double speed = velocity().norm();
  if (speed > kWalking) {
    const double along = gait_.stance_sigma + gait_.swing_time * speed;
    const Eigen::Vector2d way = velocity() / speed;
    spread += (along * along - gait_.stance_sigma * gait_.stance_sigma) * way * way.transpose();
  }
  covariance_.bottomRightCorner<2, 2>() += (1.0 - keep * keep) * spread;
}

void PersonFilter::update(const PersonMeasurement& measured) {
  const Square s = sarn_perception::innovationCovariance(covariance_, measured);
  const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 4> gain =
      s.llt().solve(measured.h * covariance_).transpose();
  state_ += gain * (measured.value - measured.h * state_);
  // Joseph's form: stays symmetric and positive whatever the rounding.
  const Covariance keep = Covariance::Identity() - gain * measured.h;
  covariance_ =
      keep * covariance_ * keep.transpose() + gain * measured.variance.asDiagonal() * gain.transpose();
}

double PersonFilter::cost(const PersonMeasurement& measured) const {
  const Square s = sarn_perception::innovationCovariance(covariance_, measured);
  const Eigen::LLT<Square> root(s);
  const auto innovation = (measured.value - measured.h * state_).eval();
  return innovation.dot(root.solve(innovation)) +
         2.0 * root.matrixL().toDenseMatrix().diagonal().array().log().sum();
}

Eigen::Matrix2d PersonFilter::innovationCovariance(double sigma, double age) const {
  return sarn_perception::innovationCovariance(covariance_, middleAt(Eigen::Vector2d::Zero(), sigma, age));
}

double PersonFilter::positionSigma() const {
  const Eigen::Matrix2d p = covariance_.topLeftCorner<2, 2>();
  const double mean = 0.5 * p.trace();
  const double spread = std::sqrt(std::max(0.0, mean * mean - p.determinant()));
  return std::sqrt(mean + spread);
}

void PersonFilter::limitSpeed() {
  const double speed = velocity().norm();
  if (speed > gait_.max_speed) state_.segment<2>(2) *= gait_.max_speed / speed;
}

void PersonFilter::halt() { state_.segment<2>(2).setZero(); }

void PersonFilter::rest(double dt, double wander) {
  halt();
  covariance_.middleCols<2>(2).setZero();
  covariance_.middleRows<2>(2).setZero();
  covariance_.topLeftCorner<2, 2>().diagonal().array() += wander * dt;
  forgetLegs(dt);
}

}  // namespace sarn_perception
