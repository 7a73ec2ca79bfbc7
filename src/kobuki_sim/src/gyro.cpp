// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/gyro.h"

#include <cmath>

#include "sarn_common/angles.h"

namespace kobuki_sim {

Gyro::Gyro(const Params& params, std::uint64_t seed)
    : params_(params),
      random_(seed, "gyro"),
      scale_(1.0 + params.scale_sigma * random_.normal()),
      bias_(params.bias_sigma * random_.normal()) {}

double Gyro::measure(double true_rate, double dt) {
  if (params_.bias_walk > 0.0) bias_ += params_.bias_walk * std::sqrt(dt) * random_.normal();
  const double white = params_.noise > 0.0 ? params_.noise / std::sqrt(dt) * random_.normal() : 0.0;
  rate_ = scale_ * true_rate + bias_ + white;
  angle_ = sarn::wrapAngle(angle_ + rate_ * dt);
  return rate_;
}

}  // namespace kobuki_sim
