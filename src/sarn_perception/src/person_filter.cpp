// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/person_filter.h"

#include <Eigen/LU>
#include <cmath>

namespace sarn_perception {
namespace {

Eigen::Matrix<double, 2, 4> positionBeforeMatrix(double age) {
  Eigen::Matrix<double, 2, 4> h = Eigen::Matrix<double, 2, 4>::Zero();
  h.leftCols<2>().setIdentity();
  h.rightCols<2>() = -age * Eigen::Matrix2d::Identity();
  return h;
}

}  // namespace

PersonFilter::PersonFilter(const Eigen::Vector2d& position, double position_sigma, double speed_sigma) {
  state_ << position, Eigen::Vector2d::Zero();
  const double p = position_sigma * position_sigma;
  const double v = speed_sigma * speed_sigma;
  covariance_ = Eigen::Vector4d(p, p, v, v).asDiagonal();
}

void PersonFilter::predict(double dt, double density) {
  Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
  f.topRightCorner<2, 2>() = dt * Eigen::Matrix2d::Identity();
  Eigen::Matrix4d q = Eigen::Matrix4d::Zero();
  q.topLeftCorner<2, 2>().diagonal().setConstant(density * dt * dt * dt / 3.0);
  q.topRightCorner<2, 2>().diagonal().setConstant(density * dt * dt / 2.0);
  q.bottomLeftCorner<2, 2>() = q.topRightCorner<2, 2>();
  q.bottomRightCorner<2, 2>().diagonal().setConstant(density * dt);
  state_ = f * state_;
  covariance_ = f * covariance_ * f.transpose() + q;
}

void PersonFilter::update(const Eigen::Vector2d& position, double sigma, double age) {
  const Eigen::Matrix<double, 2, 4> h = positionBeforeMatrix(age);
  const Eigen::Matrix<double, 4, 2> gain =
      covariance_ * h.transpose() * innovationCovariance(sigma, age).inverse();
  state_ += gain * (position - h * state_);
  // Joseph's form: stays symmetric and positive whatever the rounding.
  const Eigen::Matrix4d keep = Eigen::Matrix4d::Identity() - gain * h;
  covariance_ = keep * covariance_ * keep.transpose() + sigma * sigma * gain * gain.transpose();
}

Eigen::Matrix2d PersonFilter::innovationCovariance(double sigma, double age) const {
  const Eigen::Matrix<double, 2, 4> h = positionBeforeMatrix(age);
  return h * covariance_ * h.transpose() + sigma * sigma * Eigen::Matrix2d::Identity();
}

double PersonFilter::positionSigma() const {
  const Eigen::Matrix2d p = covariance_.topLeftCorner<2, 2>();
  const double mean = 0.5 * p.trace();
  const double spread = std::sqrt(std::max(0.0, mean * mean - p.determinant()));
  return std::sqrt(mean + spread);
}

void PersonFilter::halt() { state_.tail<2>().setZero(); }

void PersonFilter::rest(double dt, double wander) {
  halt();
  covariance_.rightCols<2>().setZero();
  covariance_.bottomRows<2>().setZero();
  covariance_.topLeftCorner<2, 2>().diagonal().array() += wander * dt;
}

}  // namespace sarn_perception
