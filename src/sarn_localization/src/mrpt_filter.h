// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include "sarn_common/pose2d.h"
#include "sarn_localization/localization_params.h"
#include "sarn_localization/pose_belief.h"
#include "sarn_localization/scan_likelihood.h"

namespace sarn_localization {

/// MRPT's particle filter with our observation model.
class MrptFilter : public mrpt::slam::CMonteCarloLocalization2D {
 public:
  explicit MrptFilter(const LocalizationParams& params);

  /// Moves every particle by a draw of the Gaussian `motion`, resamples by KLD sampling, and weighs by the
  /// scan. Returns the mean of ScanFit::explained over the particles.
  double update(const PoseEstimate& motion, const ScanLikelihood& scan, const WallDistance& walls);

  /// Moves every particle by a draw of the Gaussian `motion`; nothing was seen, so weights stay.
  void move(const PoseEstimate& motion);

  void setParticles(const std::vector<sarn::Pose2D>& poses);
  /// Adds poses that together have this share (0, 1) of the weight of all.
  void addParticles(const std::vector<sarn::Pose2D>& poses, double share);
  [[nodiscard]] std::vector<WeightedPose> weightedPoses() const;

 private:
  double PF_SLAM_computeObservationLikelihoodForParticle(
      const mrpt::bayes::CParticleFilter::TParticleFilterOptions& options, std::size_t particle,
      const mrpt::obs::CSensoryFrame& observation, const mrpt::poses::CPose3D& pose) const override;

  LocalizationParams params_;
  // Of the update under way.
  const ScanLikelihood* scan_ = nullptr;
  const WallDistance* walls_ = nullptr;
  mutable double explained_sum_ = 0.0;
};

}  // namespace sarn_localization
