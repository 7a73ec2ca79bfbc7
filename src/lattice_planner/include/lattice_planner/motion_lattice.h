// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "lattice_planner/planner_params.h"
#include "sarn_common/pose2d.h"

namespace lattice_planner {

/// One action from given speeds: a constant arc with the mean of old and new speeds, for one time step.
struct MotionPrimitive {
  std::uint8_t v = 0;                 // index of the forward speed afterwards
  std::uint8_t omega = 0;             // index of the angular speed afterwards
  double dtheta = 0.0;                // [rad] turn
  float base_cost = 0.0F;             // time, length and rotation cost
  float length = 0.0F;                // [m] path length, >= 0
  std::vector<sarn::Pose2D> samples;  // equal steps of time along the arc, without its start, with its end;
                                      // in the frame of the start pose
};

/// The discrete speeds and the actions {-1, 0, 1} x {-1, 0, 1} between them.
class MotionLattice {
 public:
  /// The parameters must have no problems.
  explicit MotionLattice(const PlannerParams& params);

  [[nodiscard]] int forwardSpeeds() const { return static_cast<int>(v_.size()); }
  [[nodiscard]] int angularSpeeds() const { return static_cast<int>(omega_.size()); }
  [[nodiscard]] int speedPairs() const { return forwardSpeeds() * angularSpeeds(); }
  [[nodiscard]] double v(int index) const { return v_[static_cast<std::size_t>(index)]; }          // [m/s]
  [[nodiscard]] double omega(int index) const { return omega_[static_cast<std::size_t>(index)]; }  // [rad/s]
  [[nodiscard]] int standingV() const { return standing_v_; }          // index of v = 0
  [[nodiscard]] int standingOmega() const { return standing_omega_; }  // index of omega = 0
  [[nodiscard]] int samplesPerStep() const { return samples_per_step_; }
  [[nodiscard]] double timeStep() const { return time_step_; }  // [s]

  /// Actions from speeds on the lattice.
  [[nodiscard]] const std::vector<MotionPrimitive>& from(int v, int omega) const {
    return primitives_[static_cast<std::size_t>(v * angularSpeeds() + omega)];
  }
  /// Actions from any speeds: to every lattice speed within one acceleration step; where there is none (too
  /// fast), to the nearest lattice speed.
  [[nodiscard]] std::vector<MotionPrimitive> fromAny(const sarn::Twist2D& twist) const;

  /// Smallest cost of one metre of path, people and obstacles aside.
  [[nodiscard]] double costPerMetre() const { return time_weight_ / max_speed_ + length_weight_; }
  [[nodiscard]] double maxSpeed() const { return max_speed_; }  // [m/s] the larger of forward and backward

 private:
  [[nodiscard]] MotionPrimitive primitive(const sarn::Twist2D& from, int v, int omega) const;

  double time_step_;
  double time_weight_;
  double length_weight_;
  double rotation_weight_;
  double acc_lim_x_;
  double acc_lim_theta_;
  double max_speed_;
  int samples_per_step_;
  int standing_v_;
  int standing_omega_;
  std::vector<double> v_;
  std::vector<double> omega_;
  std::vector<std::vector<MotionPrimitive>> primitives_;  // [v * angularSpeeds + omega]
};

}  // namespace lattice_planner
