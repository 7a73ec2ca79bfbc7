// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/grid_slam.h"

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sarn_common/parameters.h"

namespace sarn_localization {
namespace {

using Grid = mrpt::maps::COccupancyGridMap2D;

constexpr float kUnseen = 1e-3F;        // [1] a probability this near to one half says nothing
constexpr std::size_t kFewest = 10;     // a scan with fewer returns says nothing
constexpr float kStartHalfEdge = 5.0F;  // [m] of the map at first; it grows

const SlamParams& checked(const SlamParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("slam: " + text);
  return params;
}

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions builderOptions(const SlamParams& p) {
  mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options;
  // When a scan is used is decided before MRPT sees it.
  options.insertionLinDistance = options.insertionAngDistance = 0.0F;
  options.localizeLinDistance = options.localizeAngDistance = 0.0F;
  options.verbosity_level = mrpt::system::LVL_ERROR;
  options.PF_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  options.PF_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  options.PF_options.adaptiveSampleSize = false;
  options.PF_options.sampleSize = static_cast<unsigned>(p.particles);
  options.PF_options.BETA = p.resample_threshold;
  options.PF_options.powFactor = p.likelihood_exponent;

  Grid::TMapDefinition grid;
  grid.min_x = grid.min_y = -kStartHalfEdge;
  grid.max_x = grid.max_y = kStartHalfEdge;
  grid.resolution = static_cast<float>(p.delta);
  grid.insertionOpts.maxDistanceInsertion = static_cast<float>(p.max_urange);
  grid.insertionOpts.considerInvalidRangesAsFreeSpace = false;
  grid.insertionOpts.wideningBeamsWithDistance = false;
  grid.likelihoodOpts.likelihoodMethod = Grid::lmLikelihoodField_Thrun;
  grid.likelihoodOpts.LF_stdHit = static_cast<float>(p.sigma);
  grid.likelihoodOpts.LF_maxRange = static_cast<float>(p.max_urange);
  grid.likelihoodOpts.LF_maxCorrsDistance = 0.3F;
  grid.likelihoodOpts.LF_decimation = 2;
  options.mapsInitializers.push_back(grid);
  return options;
}

mrpt::obs::CActionCollection movement(const sarn::Pose2D& motion, const SlamParams& p) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions noise;
  noise.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  noise.gaussianModel.a1 = p.srr;
  noise.gaussianModel.a2 = p.srt;
  noise.gaussianModel.a3 = p.str;
  noise.gaussianModel.a4 = p.stt;
  noise.gaussianModel.minStdXY = 0.001;
  noise.gaussianModel.minStdPHI = 0.0002;
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry(mrpt::poses::CPose2D(motion.x, motion.y, motion.theta), noise);
  mrpt::obs::CActionCollection actions;
  actions.insert(action);
  return actions;
}

/// Every few beams of a scan, with the bias taken off; returns how many are valid.
std::size_t fill(const PlanarScan& scan, const sarn::Pose2D& base_from_sensor, const SlamParams& p,
                 mrpt::obs::CObservation2DRangeScan& out) {
  const auto stride = static_cast<std::size_t>(p.lskip) + 1;
  const std::size_t count = scan.ranges.empty() ? 0 : (scan.ranges.size() - 1) / stride + 1;
  if (count < 2 || !std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) return 0;
  const double low = std::max(scan.range_min, p.min_range);
  const double high = std::min(scan.range_max, p.max_urange);
  const double span = scan.angle_increment * static_cast<double>((count - 1) * stride);
  out.aperture = static_cast<float>(std::abs(span));
  out.rightToLeft = span > 0.0;
  out.maxRange = static_cast<float>(p.max_urange);
  out.sensorPose = mrpt::poses::CPose3D(base_from_sensor.x, base_from_sensor.y, 0.0,
                                        base_from_sensor.theta + scan.angle_min + 0.5 * span);
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

}  // namespace

struct GridSlam::Impl {
  explicit Impl(const SlamParams& p) : params(checked(p)), builder(builderOptions(params)) {
    mrpt::random::getRandomGenerator() =
        mrpt::random::CRandomGenerator(static_cast<std::uint32_t>(params.random_seed));
  }

  bool addScan(const sarn::Pose2D& robot_in_odom, const sarn::Pose2D& base_from_sensor,
               const PlanarScan& scan) {
    const sarn::Pose2D motion = sarn::inverse(odom_at_update.value_or(robot_in_odom)) * robot_in_odom;
    const bool moved =
        motion.position().norm() >= params.linear_update || std::abs(motion.theta) >= params.angular_update;
    if (odom_at_update && !moved) return false;
    auto observation = mrpt::obs::CObservation2DRangeScan::Create();
    if (fill(scan, base_from_sensor, params, *observation) < kFewest) return false;
    mrpt::obs::CActionCollection actions = movement(motion, params);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observation);
    builder.processActionObservation(actions, frame);
    odom_at_update = robot_in_odom;
    const auto pose = builder.getCurrentPoseEstimation()->getMeanVal();
    robot_in_map = {pose.x(), pose.y(), pose.yaw()};
    return true;
  }

  SlamParams params;
  mrpt::slam::CMetricMapBuilderRBPF builder;
  std::optional<sarn::Pose2D> odom_at_update;  // robot in odom
  sarn::Pose2D robot_in_map;                   // at the same time
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
  const auto* maps = impl_->builder.getCurrentlyBuiltMetricMap();
  const Grid::Ptr grid = maps != nullptr ? maps->mapByClass<Grid>() : nullptr;
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
