// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_localization/localization_params.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization/wall_distance.h"

namespace sarn_localization {

/// How well a map explains a scan from one pose.
struct ScanFit {
  double log_likelihood = 0.0;  // of all beams, as if they were independent
  double explained = 0.0;       // [0, 1] mean over the beams of exp(-d^2 / 2 sigma^2)
};

/// Likelihood field (Thrun, Burgard and Fox 2005, table 6.3): a return at a distance d from the nearest wall
/// has p = z_hit exp(-d^2 / (2 sigma^2)) + z_rand. It differs in that sigma^2 = sigma_hit^2 + (sigma_range
/// r^2)^2 grows with the range r as the noise of a structured-light camera does, and that a robot whose
/// centre is in a wall is as unlikely as a scan of which nothing fits.
class ScanLikelihood {
 public:
  ScanLikelihood(const LocalizationParams& params, ScanBeams scan);

  [[nodiscard]] ScanFit fit(const WallDistance& walls, const sarn::Pose2D& map_from_base) const;
  [[nodiscard]] const ScanBeams& scan() const { return scan_; }

 private:
  ScanBeams scan_;
  std::vector<double> precision_;  // [1/m^2] of each beam: 1 / (2 sigma^2)
  double z_hit_;
  double z_rand_;
  double cut_;  // [m]
};

}  // namespace sarn_localization
