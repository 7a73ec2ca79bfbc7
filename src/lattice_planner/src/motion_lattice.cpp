// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/motion_lattice.h"

#include <algorithm>
#include <cmath>

#include "lattice_planner/footprint.h"

namespace lattice_planner {
namespace {

/// Multiples of `step` from min to max, which are multiples themselves.
std::vector<double> multiples(double min, double max, double step) {
  std::vector<double> values;
  for (int k = static_cast<int>(std::lround(min / step)); k <= static_cast<int>(std::lround(max / step));
       ++k) {
    values.push_back(k * step);
  }
  return values;
}

/// Indices of the speeds within one acceleration step of `speed`; the nearest one when there is none.
std::vector<int> reachable(const std::vector<double>& speeds, double speed, double step) {
  std::vector<int> indices;
  int nearest = 0;
  for (int i = 0; i < static_cast<int>(speeds.size()); ++i) {
    const double difference = std::abs(speeds[static_cast<std::size_t>(i)] - speed);
    if (difference <= step * (1.0 + 1e-6)) indices.push_back(i);
    if (difference < std::abs(speeds[static_cast<std::size_t>(nearest)] - speed)) nearest = i;
  }
  if (indices.empty()) indices.push_back(nearest);
  return indices;
}

/// Neither the centre nor, while it turns, a corner goes farther between two samples than is to be checked.
int samplesFor(const PlannerParams& params) {
  const double corner = parseFootprint(params.footprint).circumscribed_radius;  // 0: round
  const double fastest = std::max(params.max_vel_x, -params.min_vel_x) + corner * params.max_vel_theta;
  return std::max(
      1, static_cast<int>(std::ceil(fastest * params.time_step / params.collision_check_distance - 1e-9)));
}

}  // namespace

MotionLattice::MotionLattice(const PlannerParams& params)
    : time_step_(params.time_step),
      time_weight_(params.time_weight),
      length_weight_(params.length_weight),
      rotation_weight_(params.rotation_weight),
      acc_lim_x_(params.acc_lim_x),
      acc_lim_theta_(params.acc_lim_theta),
      max_speed_(std::max(params.max_vel_x, -params.min_vel_x)),
      samples_per_step_(samplesFor(params)),
      v_(multiples(params.min_vel_x, params.max_vel_x, params.acc_lim_x * time_step_)),
      omega_(multiples(-params.max_vel_theta, params.max_vel_theta, params.acc_lim_theta * time_step_)) {
  standing_v_ = static_cast<int>(std::lround(-params.min_vel_x / (acc_lim_x_ * time_step_)));
  standing_omega_ = angularSpeeds() / 2;
  for (const double v : v_) {
    for (const double omega : omega_) primitives_.push_back(fromAny({v, omega}));
  }
}

std::vector<MotionPrimitive> MotionLattice::fromAny(const sarn::Twist2D& twist) const {
  std::vector<MotionPrimitive> all;
  for (const int v : reachable(v_, twist.v, acc_lim_x_ * time_step_)) {
    for (const int omega : reachable(omega_, twist.omega, acc_lim_theta_ * time_step_)) {
      all.push_back(primitive(twist, v, omega));
    }
  }
  return all;
}

MotionPrimitive MotionLattice::primitive(const sarn::Twist2D& from, int v, int omega) const {
  const sarn::Twist2D mean{0.5 * (from.v + this->v(v)), 0.5 * (from.omega + this->omega(omega))};
  MotionPrimitive p;
  p.v = static_cast<std::uint8_t>(v);
  p.omega = static_cast<std::uint8_t>(omega);
  p.dtheta = mean.omega * time_step_;
  p.length = static_cast<float>(std::abs(mean.v) * time_step_);
  p.base_cost =
      static_cast<float>(time_weight_ * time_step_ + length_weight_ * std::abs(mean.v) * time_step_ +
                         rotation_weight_ * std::abs(p.dtheta));
  for (int i = 1; i <= samples_per_step_; ++i) {
    p.samples.push_back(sarn::advance({}, mean, time_step_ * i / samples_per_step_));
  }
  return p;
}

}  // namespace lattice_planner
