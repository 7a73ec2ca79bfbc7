// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/likely_poses.h"

#include <algorithm>
#include <cmath>

namespace sarn_localization {
namespace {

constexpr double kWideSigma = 0.25;     // [m] of the first look
constexpr std::size_t kWideBeams = 20;  // of the first look
constexpr std::size_t kClimbers = 3;    // for each pose that is asked for
constexpr int kClimbSteps = 12;
constexpr double kClimbXy = 0.15;   // [m] sigma of the first step
constexpr double kClimbPhi = 0.08;  // [rad]
constexpr double kCooling = 0.85;   // [1] from step to step

sarn::Pose2D anyFreePose(const WallDistance& walls, std::mt19937_64& random) {
  const auto& cells = walls.freeCells();
  std::uniform_int_distribution<std::size_t> pick(0, cells.size() - 1);
  std::uniform_real_distribution<double> within(-0.5 * walls.geometry().resolution,
                                                0.5 * walls.geometry().resolution);
  std::uniform_real_distribution<double> heading(-sarn::kPi, sarn::kPi);
  const Eigen::Vector2d center = walls.geometry().center(cells[pick(random)]);
  const double x = center.x() + within(random);
  const double y = center.y() + within(random);
  return {x, y, heading(random)};
}

/// `count` draws with replacement, by the exponentials of log_weights.
std::vector<sarn::Pose2D> draw(const std::vector<sarn::Pose2D>& poses, std::vector<double> log_weights,
                               std::size_t count, std::mt19937_64& random) {
  const double greatest = *std::max_element(log_weights.begin(), log_weights.end());
  for (double& weight : log_weights) weight = std::exp(weight - greatest);
  std::discrete_distribution<std::size_t> pick(log_weights.begin(), log_weights.end());
  std::vector<sarn::Pose2D> drawn(count);
  for (sarn::Pose2D& pose : drawn) pose = poses[pick(random)];
  return drawn;
}

/// Moves a pose to a better one nearby; its log-likelihood.
double climb(const WallDistance& walls, const ScanLikelihood& scan, sarn::Pose2D& pose,
             std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double best = scan.fit(walls, pose).log_likelihood;
  double scale = 1.0;
  for (int i = 0; i < kClimbSteps; ++i, scale *= kCooling) {
    sarn::Pose2D next = pose;
    next.x += scale * kClimbXy * normal(random);
    next.y += scale * kClimbXy * normal(random);
    next.theta = sarn::wrapAngle(next.theta + scale * kClimbPhi * normal(random));
    const double value = scan.fit(walls, next).log_likelihood;
    if (value <= best) continue;
    best = value;
    pose = next;
  }
  return best;
}

}  // namespace

std::vector<sarn::Pose2D> drawLikelyPoses(const WallDistance& walls, const LocalizationParams& params,
                                          const ScanBeams& scan, std::size_t candidates, std::size_t count,
                                          std::mt19937_64& random) {
  LocalizationParams wide_params = params;
  wide_params.laser_sigma_hit = kWideSigma;
  const ScanLikelihood wide(wide_params, everyFewBeams(scan, kWideBeams));
  std::vector<sarn::Pose2D> poses(candidates);
  std::vector<double> log_weights(candidates);
  for (std::size_t i = 0; i < candidates; ++i) {
    poses[i] = anyFreePose(walls, random);
    log_weights[i] = wide.fit(walls, poses[i]).log_likelihood;
  }
  poses = draw(poses, std::move(log_weights), kClimbers * count, random);

  const ScanLikelihood narrow(params, scan);
  log_weights.assign(poses.size(), 0.0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    log_weights[i] = params.likelihood_exponent * climb(walls, narrow, poses[i], random);
  }
  return draw(poses, std::move(log_weights), count, random);
}

}  // namespace sarn_localization
