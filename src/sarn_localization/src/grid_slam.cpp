// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/grid_slam.h"

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CMultiMetricMapPDF.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sarn_common/parameters.h"
#include "sarn_localization/right_angles.h"
#include "sarn_localization/scan_match.h"
#include "sarn_localization/wall_lines.h"

namespace sarn_localization {
namespace {

using Grid = mrpt::maps::COccupancyGridMap2D;

constexpr float kUnseen = 1e-3F;     // [1] a probability this near to one half says nothing
constexpr std::size_t kFewest = 10;  // a scan with fewer returns says nothing

const SlamParams& checked(const SlamParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("slam: " + text);
  return params;
}

mrpt::bayes::CParticleFilter::TParticleFilterOptions filterOptions(const SlamParams& p) {
  mrpt::bayes::CParticleFilter::TParticleFilterOptions options;
  options.PF_algorithm = mrpt::bayes::CParticleFilter::pfOptimalProposal;
  options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  options.adaptiveSampleSize = false;
  options.sampleSize = static_cast<unsigned>(p.particles);
  return options;
}

// Each particle has two grids. Beams that graze a wall pass through the cells that others hit, and wear it
// off on the near side: matched against such a map, scans turn and shift it a little with each step. So scans
// are matched against a grid in which a beam hardly clears what it passes; the other one, which forgets
// people soon, is the map.
constexpr std::size_t kPublished = 0;
constexpr std::size_t kMatched = 1;
constexpr double kMatchingFreeCertainty = 0.52;  // [1] that a cell is free, from one beam through it

mrpt::maps::TSetOfMetricMapInitializers gridsOf(const SlamParams& p) {
  Grid::TMapDefinition grid;
  grid.min_x = static_cast<float>(p.xmin);
  grid.min_y = static_cast<float>(p.ymin);
  grid.max_x = static_cast<float>(p.xmax);
  grid.max_y = static_cast<float>(p.ymax);
  grid.resolution = static_cast<float>(p.delta);
  grid.insertionOpts.maxDistanceInsertion = static_cast<float>(p.max_urange);
  grid.insertionOpts.considerInvalidRangesAsFreeSpace = false;
  grid.insertionOpts.wideningBeamsWithDistance = false;
  mrpt::maps::TSetOfMetricMapInitializers initializers;
  initializers.push_back(grid);
  grid.insertionOpts.maxFreenessUpdateCertainty = static_cast<float>(kMatchingFreeCertainty);
  initializers.push_back(grid);
  return initializers;
}

/// What scan matching asks of MRPT's grid.
class GridView {
 public:
  explicit GridView(const Grid& grid) : grid_(grid) {}
  [[nodiscard]] double resolution() const { return static_cast<double>(grid_.getResolution()); }
  [[nodiscard]] double centerX(int x) const {
    return static_cast<double>(grid_.getXMin()) + (x + 0.5) * resolution();
  }
  [[nodiscard]] double centerY(int y) const {
    return static_cast<double>(grid_.getYMin()) + (y + 0.5) * resolution();
  }
  [[nodiscard]] int cellX(double x) const { return grid_.x2idx(static_cast<float>(x)); }
  [[nodiscard]] int cellY(double y) const { return grid_.y2idx(static_cast<float>(y)); }
  /// MRPT's cells hold the probability that they are free; outside it says one half.
  [[nodiscard]] double occupancy(int x, int y) const {
    return 1.0 - static_cast<double>(grid_.getCell(x, y));
  }

 private:
  const Grid& grid_;
};

/// Standard errors of a motion that took so many seconds: x, y [m], theta [rad].
Eigen::Vector3d motionSigma(const sarn::Pose2D& motion, double seconds, const SlamParams& p) {
  constexpr double kLeastXy = 0.001;      // [m]
  constexpr double kLeastTheta = 0.0005;  // [rad]
  const double d = motion.position().norm();
  const double turn = std::abs(motion.theta);
  const double xy = kLeastXy + p.srr * d + p.srt * turn;
  return {xy, xy, kLeastTheta + p.str * d + p.stt * turn + p.gyro_drift * seconds};
}

/// Every few beams of a scan, with the biases taken off; returns how many are valid. MRPT's grid spreads n
/// beams over an aperture in steps of aperture / n from its edge, its maps of points in steps of aperture /
/// (n - 1): a quarter of a degree between drawing and matching that would turn the map a little with each
/// scan. So the aperture here is n steps, and where the beams ended is told by endsOf.
std::size_t fill(const PlanarScan& scan, const sarn::Pose2D& base_from_sensor, const SlamParams& p,
                 mrpt::obs::CObservation2DRangeScan& out) {
  const auto stride = static_cast<std::size_t>(p.lskip) + 1;
  const std::size_t count = scan.ranges.empty() ? 0 : (scan.ranges.size() - 1) / stride + 1;
  if (count < 2 || !std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) return 0;
  const double low = std::max(scan.range_min, p.min_range);
  const double high = std::min(scan.range_max, p.max_urange);
  const double span = scan.angle_increment * static_cast<double>(count * stride);
  out.aperture = static_cast<float>(std::abs(span));
  out.rightToLeft = span > 0.0;
  out.maxRange = static_cast<float>(p.max_urange);
  out.sensorPose = mrpt::poses::CPose3D(
      base_from_sensor.x, base_from_sensor.y, 0.0,
      base_from_sensor.theta + scan.angle_min + p.laser_beam_offset * scan.angle_increment + 0.5 * span);
  out.resizeScan(count);
  std::size_t valid = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto measured = static_cast<double>(scan.ranges[k * stride]);
    const bool usable = measured >= low && measured <= high;
    const double range = usable ? measured + p.laser_range_bias * measured * measured : 0.0;
    out.setScanRange(k, static_cast<float>(range));
    out.setScanRangeValidity(k, usable);
    if (usable) ++valid;
  }
  return valid;
}

/// Where valid beams ended [m], in base.
std::vector<Eigen::Vector2d> endsOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  std::vector<Eigen::Vector2d> ends;
  const sarn::Pose2D base_from_sensor{scan.sensorPose.x(), scan.sensorPose.y(), scan.sensorPose.yaw()};
  const auto count = static_cast<double>(scan.getScanSize());
  const double span = (scan.rightToLeft ? 1.0 : -1.0) * static_cast<double>(scan.aperture);
  for (std::size_t k = 0; k < scan.getScanSize(); ++k) {
    if (!scan.getScanRangeValidity(k)) continue;
    const double bearing = span * (static_cast<double>(k) / count - 0.5);
    const auto range = static_cast<double>(scan.getScanRange(k));
    ends.emplace_back(base_from_sensor *
                      Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing)));
  }
  return ends;
}

}  // namespace

struct GridSlam::Impl {
  explicit Impl(const SlamParams& p)
      : params(checked(p)),
        options(filterOptions(params)),
        filter(options, gridsOf(params), {}),
        robot_in_map{params.initial_pose_x, params.initial_pose_y, params.initial_pose_a},
        compass(robot_in_map.theta) {
    mrpt::random::getRandomGenerator() =
        mrpt::random::CRandomGenerator(static_cast<std::uint32_t>(params.random_seed));
    filter.clear(mrpt::poses::CPose2D(robot_in_map.x, robot_in_map.y, robot_in_map.theta));
  }

  bool addScan(const sarn::Pose2D& robot_in_odom, const sarn::Pose2D& base_from_sensor,
               const PlanarScan& scan) {
    const sarn::Pose2D motion = sarn::inverse(odom_at_update.value_or(robot_in_odom)) * robot_in_odom;
    const bool moved =
        motion.position().norm() >= params.linear_update || std::abs(motion.theta) >= params.angular_update;
    if (odom_at_update && !moved) return false;
    auto observation = mrpt::obs::CObservation2DRangeScan::Create();
    if (fill(scan, base_from_sensor, params, *observation) < kFewest) return false;
    const std::vector<Eigen::Vector2d> ends = endsOf(*observation);
    const Eigen::Vector3d sigma = motionSigma(motion, std::max(0.0, scan.time - time_at_update), params);
    lookAtWalls(motion.theta, sigma.z(), ends, base_from_sensor);
    if (odom_at_update) {
      moveParticles(motion, sigma, onePerCell(ends, params.delta));
      filter.normalizeWeights();
      if (filter.ESS() < params.resample_threshold) filter.performResampling(options);
    }
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observation);
    filter.insertObservation(frame);
    odom_at_update = robot_in_odom;
    time_at_update = scan.time;
    robot_in_map = pose(likeliest());
    return true;
  }

  [[nodiscard]] std::size_t likeliest() const {
    const auto& particles = filter.m_particles;
    const auto best = std::max_element(particles.begin(), particles.end(),
                                       [](const auto& a, const auto& b) { return a.log_w < b.log_w; });
    return static_cast<std::size_t>(best - particles.begin());
  }
  [[nodiscard]] Grid::Ptr grid(std::size_t particle, std::size_t which) const {
    return filter.m_particles[particle].d->mapTillNow.mapByClass<Grid>(which);
  }

 private:
  [[nodiscard]] sarn::Pose2D pose(std::size_t particle) const {
    const auto& last = filter.m_particles[particle].d->robotPath.back();
    return {last.x, last.y, last.yaw};
  }

  void lookAtWalls(double turn, double turn_sigma, const std::vector<Eigen::Vector2d>& ends,
                   const sarn::Pose2D& base_from_sensor) {
    if (!params.right_angles) return;
    if (odom_at_update) compass.turn(turn, turn_sigma);
    WallLineParams lines;
    lines.sigma = params.wall_sigma;
    lines.sigma_range = params.wall_sigma_range;
    compass.see(wallLines(ends, base_from_sensor.position(), lines));
  }

  /// A particle's heading by odometry, and how the walls correct it.
  [[nodiscard]] HeadingBelief withCompass(const HeadingBelief& predicted) const {
    const std::optional<HeadingBelief> seen =
        params.right_angles ? compass.heading() : std::optional<HeadingBelief>();
    if (!seen) return predicted;
    const double own = predicted.sigma * predicted.sigma;
    const double share = own / (own + seen->sigma * seen->sigma);
    return {predicted.theta + share * sarn::angleDifference(predicted.theta, seen->theta),
            predicted.sigma * std::sqrt(1.0 - share)};
  }

  /// Draws each particle's next pose from where odometry, scan and its own map agree, and weighs it by how
  /// well they do.
  void moveParticles(const sarn::Pose2D& motion, Eigen::Vector3d sigma,
                     const std::vector<Eigen::Vector2d>& ends) {
    const double turn_sigma = sigma.z();
    const ScanMatchParams matching{params.match_reach, 0.5 * params.match_reach, params.sigma, 2.0,
                                   params.match_exponent};
    for (std::size_t i = 0; i < filter.m_particles.size(); ++i) {
      sarn::Pose2D predicted = pose(i) * motion;
      const HeadingBelief heading = withCompass({predicted.theta, turn_sigma});
      predicted.theta = heading.theta;
      sigma.z() = heading.sigma;
      const ScanMatch match = matchScan(GridView(*grid(i, kMatched)), ends, predicted, sigma, matching);
      const Eigen::Matrix3d root = match.covariance.llt().matrixL();
      auto& random = mrpt::random::getRandomGenerator();
      Eigen::Vector3d draw;
      for (double& value : draw) value = random.drawGaussian1D_normalized();
      const Eigen::Vector3d error = root * draw;
      auto& particle = filter.m_particles[i];
      particle.d->robotPath.emplace_back(match.pose.x + error.x(), match.pose.y + error.y(), 0.0,
                                         sarn::wrapAngle(match.pose.theta + error.z()), 0.0, 0.0);
      particle.log_w += params.likelihood_exponent * match.log_likelihood;
    }
  }

 public:
  SlamParams params;
  mrpt::bayes::CParticleFilter::TParticleFilterOptions options;
  mrpt::maps::CMultiMetricMapPDF filter;
  std::optional<sarn::Pose2D> odom_at_update;  // robot in odom
  double time_at_update = 0.0;                 // [s]
  sarn::Pose2D robot_in_map;                   // at the same time
  RightAngles compass;
};

GridSlam::GridSlam(const SlamParams& params) : impl_(std::make_unique<Impl>(params)) {}
GridSlam::~GridSlam() = default;
GridSlam::GridSlam(GridSlam&&) noexcept = default;
GridSlam& GridSlam::operator=(GridSlam&&) noexcept = default;

bool GridSlam::addScan(const sarn::Pose2D& robot_in_odom, const sarn::Pose2D& base_from_sensor,
                       const PlanarScan& scan) {
  return impl_->addScan(robot_in_odom, base_from_sensor, scan);
}

std::optional<sarn::Pose2D> GridSlam::mapFromOdom() const {
  if (!impl_->odom_at_update) return std::nullopt;
  return impl_->robot_in_map * sarn::inverse(*impl_->odom_at_update);
}

std::optional<sarn::OccupancyMap> GridSlam::map() const {
  if (!impl_->odom_at_update) return std::nullopt;
  const Grid::Ptr grid = impl_->grid(impl_->likeliest(), kPublished);
  if (!grid) return std::nullopt;
  const int width = static_cast<int>(grid->getSizeX());
  const int height = static_cast<int>(grid->getSizeY());
  sarn::OccupancyMap map({width, height, impl_->params.delta, static_cast<double>(grid->getXMin()),
                          static_cast<double>(grid->getYMin())},
                         sarn::kMapUnknown);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float free = grid->getCell(x, y);
      if (std::abs(free - 0.5F) < kUnseen) continue;
      map.at({x, y}) =
          1.0F - free > static_cast<float>(impl_->params.occ_thresh) ? sarn::kMapOccupied : sarn::kMapFree;
    }
  }
  return map;
}

}  // namespace sarn_localization
