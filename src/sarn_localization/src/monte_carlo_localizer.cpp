// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/monte_carlo_localizer.h"

#include <mrpt/random/RandomGenerators.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "mrpt_filter.h"
#include "sarn_common/parameters.h"
#include "sarn_localization/distance_filter.h"
#include "sarn_localization/likely_poses.h"
#include "sarn_localization/motion_model.h"
#include "sarn_localization/recent_scans.h"
#include "sarn_localization/recovery_monitor.h"

namespace sarn_localization {
namespace {

constexpr std::size_t kFewestBeams = 5;     // a scan with fewer returns says nothing
constexpr std::size_t kPolled = 20;         // particles that the distance filter asks
constexpr double kLeastRandomShare = 0.15;  // [1] less is noise of the averages
constexpr double kGreatestRandomShare =
    0.1;  // [1] of the belief at once: less than the distance filter asks for
constexpr std::size_t kGlobalCandidates = 5;  // global localisation looks at this many times the candidates

constexpr double kContent = 0.85;    // [1] of recent returns explained: no reason to look elsewhere
constexpr double kMostOfIt = 0.7;    // [1] of recent returns: a place that explains less is none
constexpr int kLookEvery = 4;        // remembered scans
constexpr double kAlike = 0.05;      // [1] explained less than by the best place: may be it too
constexpr double kRivalShare = 0.5;  // [1] of the belief, for such places

const LocalizationParams& checked(const LocalizationParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("localization: " + text);
  return params;
}

/// A matrix whose product with its transpose is the covariance, which may be singular.
Eigen::Matrix3d squareRoot(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace

struct MonteCarloLocalizer::Impl {
  enum class Knowledge { kNothing, kBelief, kAnywhere };

  explicit Impl(const LocalizationParams& p)
      : params(checked(p)),
        filter(params),
        monitor(params.recovery_alpha_slow, params.recovery_alpha_fast),
        random(static_cast<std::uint64_t>(params.random_seed)) {
    // A generator anew, as randomize() would leave half a pair of normal draws in it.
    mrpt::random::getRandomGenerator() =
        mrpt::random::CRandomGenerator(static_cast<std::uint32_t>(params.random_seed));
  }

  void setPose(const PoseEstimate& robot_in_map, const sarn::Pose2D& robot_in_odom) {
    const Eigen::Matrix3d root = squareRoot(robot_in_map.covariance);
    std::normal_distribution<double> normal;
    std::vector<sarn::Pose2D> poses(static_cast<std::size_t>(params.max_particles));
    for (sarn::Pose2D& pose : poses) {
      const Eigen::Vector3d z(normal(random), normal(random), normal(random));
      const Eigen::Vector3d d = root * z;
      pose = {robot_in_map.pose.x + d.x(), robot_in_map.pose.y + d.y(),
              sarn::wrapAngle(robot_in_map.pose.theta + d.z())};
    }
    filter.setParticles(poses);
    knowledge = Knowledge::kBelief;
    monitor.forgetFast();
    recent.clear();
    odom_at_update = robot_in_odom;
    estimate = robot_in_map;
    force_update = true;
  }

  [[nodiscard]] bool movedEnough(const sarn::Pose2D& motion) const {
    return motion.position().norm() >= params.update_min_d || std::abs(motion.theta) >= params.update_min_a;
  }

  /// Poses of some particles, drawn by weight.
  [[nodiscard]] std::vector<sarn::Pose2D> poll() {
    const std::vector<WeightedPose> all = filter.weightedPoses();
    std::vector<double> weights(all.size());
    std::transform(all.begin(), all.end(), weights.begin(), [](const WeightedPose& p) { return p.weight; });
    std::discrete_distribution<std::size_t> draw(weights.begin(), weights.end());
    std::vector<sarn::Pose2D> poses(kPolled);
    for (sarn::Pose2D& pose : poses) pose = all[draw(random)].pose;
    return poses;
  }

  [[nodiscard]] ScanBeams withoutPeople(const ScanBeams& scan, const sarn::Pose2D& motion) {
    if (!params.do_beamskip) return scan;
    std::vector<sarn::Pose2D> belief = poll();
    for (sarn::Pose2D& pose : belief) pose = pose * motion;
    return withoutShortBeams(
        scan, belief, *walls,
        {params.beam_skip_distance, params.beam_skip_threshold,
         scan.coverage < params.least_coverage ? 1.0 : params.beam_skip_error_threshold});
  }

  void spreadOverMap(const ScanBeams& scan) {
    const auto candidates = kGlobalCandidates * static_cast<std::size_t>(params.recovery_candidates);
    filter.setParticles(drawLikelyPoses(*walls, params, scan, candidates,
                                        static_cast<std::size_t>(params.max_particles), random));
    knowledge = Knowledge::kBelief;
    monitor.forgetFast();
    recent.clear();
  }

  /// Gives a share of the belief to poses that the scan makes likely.
  void addRandomParticles(double share, const ScanBeams& scan) {
    if (share < kLeastRandomShare) return;
    filter.addParticles(
        drawLikelyPoses(*walls, params, scan, static_cast<std::size_t>(params.recovery_candidates),
                        static_cast<std::size_t>(params.min_particles), random),
        std::min(share, kGreatestRandomShare));
  }

  /// Gives half of the belief to another place that explains the last stretch of the way better.
  ///
  /// A robot that took one room for another like it dismisses as people what tells them apart: the distance
  /// filter asks a belief that is of one mind, and what it leaves out neither lowers the likelihood that
  /// recovery watches nor speaks for the right place. So here all returns count. People who are in view raise
  /// the doubt, but no other place explains them and all else on the stretch, nor most of what a crowd shows
  /// that hides every wall. And beams are not left out while half of the belief explains them, so that the
  /// next scans decide.
  void lookElsewhere(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan) {
    if (params.recovery_margin >= 1.0 || scan.coverage < params.least_coverage) return;
    if (!recent.add(robot_in_odom, scan) || !recent.full() || ++looks_ago < kLookEvery) return;
    const ScanLikelihood stretch(params, recent.seenFrom(robot_in_odom));
    const double here = stretch.fit(*walls, estimate->pose).explained;
    if (here > kContent) return;
    looks_ago = 0;
    const std::vector<sarn::Pose2D> rivals =
        placesThatExplain(stretch, std::max(kMostOfIt, here + params.recovery_margin));
    if (rivals.empty()) return;
    filter.addParticles(rivals, kRivalShare);
    recent.clear();
  }

  /// Poses that explain at least that share of the returns and hardly less than the best one does.
  [[nodiscard]] std::vector<sarn::Pose2D> placesThatExplain(const ScanLikelihood& seen, double share) {
    std::vector<WeightedPose> places;
    double best = share;
    for (const sarn::Pose2D& pose :
         drawLikelyPoses(*walls, params, seen.scan(), static_cast<std::size_t>(params.recovery_candidates),
                         static_cast<std::size_t>(params.min_particles), random)) {
      places.push_back({pose, seen.fit(*walls, pose).explained});
      best = std::max(best, places.back().weight);
    }
    std::vector<sarn::Pose2D> chosen;
    for (const auto& [pose, explained] : places) {
      if (explained >= share && explained >= best - kAlike) chosen.push_back(pose);
    }
    return chosen;
  }

  [[nodiscard]] PoseEstimate belief(const sarn::Pose2D& motion) const {
    return motionBelief(motion,
                        {params.odom_alpha1, params.odom_alpha2, params.odom_alpha3, params.odom_alpha4});
  }

  /// Carries on by odometry where nothing is seen, step by step as with scans: the motion model's noise is of
  /// short motions. The correction of the odometry stays; how sure it is falls.
  bool moveBlindly(const sarn::Pose2D& motion, const sarn::Pose2D& robot_in_odom, std::size_t people_beams) {
    if (!estimate || !movedEnough(motion)) return false;
    filter.move(belief(motion));
    estimate = PoseEstimate{estimate->pose * motion, heaviestCluster(filter.weightedPoses()).covariance};
    odom_at_update = robot_in_odom;
    status = {0, people_beams, 0.0, monitor.slow(), monitor.fast(), 0.0};
    return true;
  }

  bool addScan(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan) {
    if (!walls || knowledge == Knowledge::kNothing) return false;
    const bool anywhere = knowledge == Knowledge::kAnywhere;
    if (scan.beams.size() < kFewestBeams) {
      return !anywhere && moveBlindly(sarn::inverse(odom_at_update) * robot_in_odom, robot_in_odom, 0);
    }
    const sarn::Pose2D motion = anywhere ? sarn::Pose2D{} : sarn::inverse(odom_at_update) * robot_in_odom;
    if (!anywhere && !force_update && !movedEnough(motion)) return false;
    if (anywhere) spreadOverMap(scan);

    const ScanLikelihood likelihood(params, anywhere ? scan : withoutPeople(scan, motion));
    if (likelihood.scan().beams.empty()) return moveBlindly(motion, robot_in_odom, scan.beams.size());
    const double explained = filter.update(belief(motion), likelihood, *walls);
    const double share = scan.coverage >= params.least_coverage ? monitor.add(explained) : 0.0;
    addRandomParticles(share, likelihood.scan());

    estimate = heaviestCluster(filter.weightedPoses());
    lookElsewhere(robot_in_odom, scan);
    odom_at_update = robot_in_odom;
    force_update = false;
    status = {likelihood.scan().beams.size(),
              scan.beams.size() - likelihood.scan().beams.size(),
              explained,
              monitor.slow(),
              monitor.fast(),
              share};
    return true;
  }

  LocalizationParams params;
  MrptFilter filter;
  RecoveryMonitor monitor;
  RecentScans recent;
  int looks_ago = kLookEvery;  // remembered scans since lookElsewhere() last searched
  std::mt19937_64 random;
  std::optional<WallDistance> walls;
  Knowledge knowledge = Knowledge::kNothing;
  bool force_update = false;
  sarn::Pose2D odom_at_update;  // robot in odom
  std::optional<PoseEstimate> estimate;
  LocalizerStatus status;
};

MonteCarloLocalizer::MonteCarloLocalizer(const LocalizationParams& params)
    : impl_(std::make_unique<Impl>(params)) {}
MonteCarloLocalizer::~MonteCarloLocalizer() = default;
MonteCarloLocalizer::MonteCarloLocalizer(MonteCarloLocalizer&&) noexcept = default;
MonteCarloLocalizer& MonteCarloLocalizer::operator=(MonteCarloLocalizer&&) noexcept = default;

void MonteCarloLocalizer::setMap(const sarn::OccupancyMap& map) { impl_->walls = WallDistance(map); }
bool MonteCarloLocalizer::hasMap() const { return impl_->walls.has_value(); }

void MonteCarloLocalizer::setPose(const PoseEstimate& robot_in_map, const sarn::Pose2D& robot_in_odom) {
  impl_->setPose(robot_in_map, robot_in_odom);
}

void MonteCarloLocalizer::localizeGlobally() {
  impl_->knowledge = Impl::Knowledge::kAnywhere;
  impl_->estimate.reset();
}

bool MonteCarloLocalizer::addScan(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan) {
  return impl_->addScan(robot_in_odom, scan);
}

std::optional<PoseEstimate> MonteCarloLocalizer::estimate() const { return impl_->estimate; }

std::optional<sarn::Pose2D> MonteCarloLocalizer::mapFromOdom() const {
  if (!impl_->estimate) return std::nullopt;
  return impl_->estimate->pose * sarn::inverse(impl_->odom_at_update);
}

std::vector<WeightedPose> MonteCarloLocalizer::particles() const {
  return impl_->knowledge == Impl::Knowledge::kBelief ? impl_->filter.weightedPoses()
                                                      : std::vector<WeightedPose>{};
}

const LocalizerStatus& MonteCarloLocalizer::status() const { return impl_->status; }

}  // namespace sarn_localization
