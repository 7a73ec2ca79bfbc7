// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kobuki_sim/random.h"

namespace kobuki_sim {

/// Single-axis rate gyro: rate * (1 + scale error) + bias + white noise, the bias walking slowly (the angle
/// random walk and rate random walk of IEEE Std 952-1997, appendix C).
class Gyro {
 public:
  struct Params {
    double noise = 0.0;        // [rad/s/sqrt(Hz)]
    double bias_sigma = 0.0;   // [rad/s] at the start
    double bias_walk = 0.0;    // [rad/s/sqrt(s)]
    double scale_sigma = 0.0;  // [1]
  };

  Gyro(const Params& params, std::uint64_t seed);

  /// Measures a true rate [rad/s] held for dt [s]; returns the measured rate [rad/s].
  double measure(double true_rate, double dt);

  [[nodiscard]] double angle() const { return angle_; }  // [rad] integrated measured rate, (-pi, pi]
  [[nodiscard]] double rate() const { return rate_; }    // [rad/s] last measured
  [[nodiscard]] double bias() const { return bias_; }    // [rad/s]

 private:
  Params params_;
  RandomStream random_;
  double scale_;
  double bias_;
  double angle_ = 0.0;
  double rate_ = 0.0;
};

}  // namespace kobuki_sim
