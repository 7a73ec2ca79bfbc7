// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/scan_likelihood.h"

#include <cmath>
#include <utility>

namespace sarn_localization {

ScanLikelihood::ScanLikelihood(const LocalizationParams& params, ScanBeams scan)
    : scan_(std::move(scan)),
      z_hit_(params.laser_z_hit),
      z_rand_(params.laser_z_rand),
      cut_(params.laser_likelihood_max_dist) {
  precision_.reserve(scan_.beams.size());
  for (const Beam& beam : scan_.beams) {
    const double sigma_range = params.laser_sigma_range * beam.range * beam.range;
    const double variance = params.laser_sigma_hit * params.laser_sigma_hit + sigma_range * sigma_range;
    precision_.push_back(0.5 / variance);
  }
}

ScanFit ScanLikelihood::fit(const WallDistance& walls, const sarn::Pose2D& map_from_base) const {
  ScanFit fit;
  if (scan_.beams.empty()) return fit;
  if (!walls.open(map_from_base.position())) {
    fit.log_likelihood = static_cast<double>(scan_.beams.size()) * std::log(z_rand_);
    return fit;
  }
  const double c = std::cos(map_from_base.theta);
  const double s = std::sin(map_from_base.theta);
  double product = 1.0;  // of a few beams, so that not each needs a logarithm
  for (std::size_t i = 0; i < scan_.beams.size(); ++i) {
    const Eigen::Vector2d& end = scan_.beams[i].end;
    const double distance = walls.at(
        {map_from_base.x + c * end.x() - s * end.y(), map_from_base.y + s * end.x() + c * end.y()}, cut_);
    const double hit = std::exp(-distance * distance * precision_[i]);
    fit.explained += hit;
    product *= z_hit_ * hit + z_rand_;
    if (i % 16 == 15) {
      fit.log_likelihood += std::log(product);
      product = 1.0;
    }
  }
  fit.log_likelihood += std::log(product);
  fit.explained /= static_cast<double>(scan_.beams.size());
  return fit;
}

}  // namespace sarn_localization
