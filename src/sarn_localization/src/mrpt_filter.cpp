// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_filter.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <cmath>

namespace sarn_localization {
namespace {

constexpr double kLeastVariance = 1e-8;  // [m^2], [rad^2] so that a covariance is never singular
constexpr double kBinXy = 0.1;           // [m] of KLD sampling
constexpr double kBinPhi = 0.09;         // [rad]

mrpt::math::TPose2D toMrpt(const sarn::Pose2D& pose) { return {pose.x, pose.y, pose.theta}; }

mrpt::poses::CPosePDFGaussian gaussian(const PoseEstimate& motion) {
  mrpt::math::CMatrixDouble33 covariance(motion.covariance);
  for (int i = 0; i < 3; ++i) covariance(i, i) += kLeastVariance;
  return {mrpt::poses::CPose2D(toMrpt(motion.pose)), covariance};
}

mrpt::obs::CActionCollection movement(const PoseEstimate& motion) {
  mrpt::obs::CActionRobotMovement2D action;
  action.poseChange = mrpt::poses::CPosePDFGaussian::Create(gaussian(motion));
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  return actions;
}

mrpt::bayes::CParticleFilter::TParticleFilterOptions filterOptions(const LocalizationParams& params) {
  mrpt::bayes::CParticleFilter::TParticleFilterOptions options;
  options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  options.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
  options.adaptiveSampleSize = true;
  options.powFactor = params.likelihood_exponent;
  return options;
}

}  // namespace

MrptFilter::MrptFilter(const LocalizationParams& p) : params_(p) {
  options.KLD_params.KLD_binSize_XY = kBinXy;
  options.KLD_params.KLD_binSize_PHI = kBinPhi;
  options.KLD_params.KLD_epsilon = params_.kld_err;
  options.KLD_params.KLD_delta = 1.0 - params_.kld_z;
  options.KLD_params.KLD_minSampleSize = static_cast<unsigned>(params_.min_particles);
  options.KLD_params.KLD_maxSampleSize = static_cast<unsigned>(params_.max_particles);
  // MRPT insists on a map although the likelihood does not come from it.
  options.metricMap = mrpt::maps::COccupancyGridMap2D::Create();
}

double MrptFilter::update(const PoseEstimate& motion, const ScanLikelihood& scan, const WallDistance& walls) {
  scan_ = &scan;
  walls_ = &walls;
  explained_sum_ = 0.0;
  const mrpt::obs::CActionCollection actions = movement(motion);
  const mrpt::obs::CSensoryFrame observations;
  const auto filter_options = filterOptions(params_);
  prediction_and_update_pfStandardProposal(&actions, &observations, filter_options);
  normalizeWeights();
  scan_ = nullptr;
  walls_ = nullptr;
  return explained_sum_ / static_cast<double>(m_particles.size());
}

double MrptFilter::PF_SLAM_computeObservationLikelihoodForParticle(
    const mrpt::bayes::CParticleFilter::TParticleFilterOptions& /*options*/, std::size_t /*particle*/,
    const mrpt::obs::CSensoryFrame& /*observation*/, const mrpt::poses::CPose3D& pose) const {
  const ScanFit fit = scan_->fit(*walls_, {pose.x(), pose.y(), pose.yaw()});
  explained_sum_ += fit.explained;
  return fit.log_likelihood;
}

void MrptFilter::move(const PoseEstimate& motion) {
  const mrpt::poses::CPosePDFGaussian belief = gaussian(motion);
  mrpt::poses::CPose2D drawn;
  for (auto& particle : m_particles) {
    belief.drawSingleSample(drawn);
    particle.d = (mrpt::poses::CPose2D(particle.d) + drawn).asTPose();
  }
}

void MrptFilter::setParticles(const std::vector<sarn::Pose2D>& poses) {
  m_particles.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    m_particles[i].d = toMrpt(poses[i]);
    m_particles[i].log_w = 0.0;
  }
}

void MrptFilter::addParticles(const std::vector<sarn::Pose2D>& poses, double share) {
  double total = 0.0;
  for (const auto& particle : m_particles) total += std::exp(particle.log_w);
  const double weight = total * share / ((1.0 - share) * static_cast<double>(poses.size()));
  for (const sarn::Pose2D& pose : poses) {
    m_particles.emplace_back(toMrpt(pose), std::log(weight));
  }
  normalizeWeights();
}

std::vector<WeightedPose> MrptFilter::weightedPoses() const {
  std::vector<WeightedPose> poses;
  poses.reserve(m_particles.size());
  for (const auto& particle : m_particles) {
    poses.push_back({{particle.d.x, particle.d.y, particle.d.phi}, std::exp(particle.log_w)});
  }
  return poses;
}

}  // namespace sarn_localization
