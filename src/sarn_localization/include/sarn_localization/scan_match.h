// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_common/pose2d.h"

namespace sarn_localization {

/// Scan matching against an occupancy grid, with the odometry as prior: the mode and the spread of
/// p(x | map, scan, odometry) for the proposal of a Rao-Blackwellised filter (Grisetti, Stachniss and Burgard
/// 2007, "Improved Techniques for Grid Mapping with Rao-Blackwellized Particle Filters", eq. 9 to 13). The
/// grid about a beam's end is taken as a normal distribution (Biber and Strasser 2003, "The Normal
/// Distributions Transform"), whose wide axis lies along a wall: what a scan cannot tell, as how far along a
/// corridor the robot is, stays with the odometry.
struct ScanMatchParams {
  double coarse_reach = 0.16;  // [m] standard deviation of the window about a beam's end, at first
  double fine_reach = 0.07;    // [m] in the end
  double range_sigma = 0.02;   // [m] of a return about its wall
  double scale = 2.0;          // [1] normalised distance from which a return's pull fades: people
  double exponent = 0.1;       // [1] neighbouring beams err together: (product of beams)^exponent
};

/// What a scan says about a pose.
struct ScanMatch {
  sarn::Pose2D pose;                                     // the likeliest
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of x, y [m], theta [rad]
  double log_likelihood = 0.0;                           // of all beams at that pose, up to a constant
};

/// Occupied cells about a point, as a normal distribution.
struct SurfacePatch {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();        // [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // [m^2]
};

/// The patch about `point` [m] of a grid, through a window of standard deviation `reach` [m]; nothing where
/// hardly anything is occupied. `Grid` offers `double resolution()`, `double centerX(int)`, `centerY(int)`,
/// `int cellX(double)`, `cellY(double)` and `double occupancy(int x, int y)` in [0, 1], 0.5 when it does not
/// know, or lies outside.
template <class Grid>
[[nodiscard]] std::optional<SurfacePatch> patchAbout(const Grid& grid, const Eigen::Vector2d& point,
                                                     double reach) {
  constexpr double kWindow = 2.0;  // in reaches
  constexpr double kLeast = 0.2;   // [1] weight of less is nothing
  const double half = kWindow * reach;
  double total = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  const int last_x = grid.cellX(point.x() + half);
  const int last_y = grid.cellY(point.y() + half);
  for (int y = grid.cellY(point.y() - half); y <= last_y; ++y) {
    for (int x = grid.cellX(point.x() - half); x <= last_x; ++x) {
      const double occupied = 2.0 * grid.occupancy(x, y) - 1.0;
      if (!(occupied > 0.0)) continue;
      const Eigen::Vector2d offset = Eigen::Vector2d(grid.centerX(x), grid.centerY(y)) - point;
      const double weight = occupied * std::exp(-0.5 * offset.squaredNorm() / (reach * reach));
      total += weight;
      sum += weight * offset;
      squares += weight * offset * offset.transpose();
    }
  }
  if (total < kLeast) return std::nullopt;
  const Eigen::Vector2d mean = sum / total;
  const double cell = grid.resolution() * grid.resolution() / 12.0;  // a cell is uniform
  return SurfacePatch{point + mean,
                      squares / total - mean * mean.transpose() + cell * Eigen::Matrix2d::Identity()};
}

/// The covariance with its wide axis made wider still, by the ratio of its axes: where a wall's patch ends is
/// the window's doing, and tells nothing.
[[nodiscard]] inline Eigen::Matrix2d acrossOnly(const Eigen::Matrix2d& covariance) {
  const double mean = 0.5 * covariance.trace();
  const double least = mean - std::sqrt(std::max(0.0, mean * mean - covariance.determinant()));
  return covariance * covariance / least;  // eigenvalues a >= b become a a / b and b
}

/// Means of neighbouring ends [m] of beams, in their order, that lie within a cell [m] of each other. They
/// meet the same cells of the grid, err with them together and count as one: taken for independent, they
/// outweigh an odometry that errs less, and what the scans err by adds up.
[[nodiscard]] inline std::vector<Eigen::Vector2d> onePerCell(const std::vector<Eigen::Vector2d>& ends,
                                                             double cell) {
  std::vector<Eigen::Vector2d> means;
  for (std::size_t first = 0; first < ends.size();) {
    Eigen::Vector2d sum = ends[first];
    std::size_t next = first + 1;
    for (; next < ends.size() && (ends[next] - ends[first]).norm() < cell; ++next) sum += ends[next];
    means.emplace_back(sum / static_cast<double>(next - first));
    first = next;
  }
  return means;
}

/// Fits beams' ends [m] in base to a grid, from `predicted`, whose standard errors are `prior_sigma` (x, y
/// [m], theta [rad], all > 0).
template <class Grid>
[[nodiscard]] ScanMatch matchScan(const Grid& grid, const std::vector<Eigen::Vector2d>& ends,
                                  const sarn::Pose2D& predicted, const Eigen::Vector3d& prior_sigma,
                                  const ScanMatchParams& params) {
  constexpr int kCoarse = 4;  // iterations with the wide window
  constexpr int kAll = 10;
  constexpr double kDone = 1e-5;      // [m, rad] a smaller step is none
  constexpr double kAnything = 0.05;  // likelihood of a beam that meets nothing known, of one that fits
  const Eigen::Matrix3d prior = prior_sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  const Eigen::Matrix2d noise = params.range_sigma * params.range_sigma * Eigen::Matrix2d::Identity();
  ScanMatch match{predicted, prior.inverse(), 0.0};
  for (int i = 0; i < kAll; ++i) {
    const double reach = i < kCoarse ? params.coarse_reach : params.fine_reach;
    Eigen::Matrix3d information = prior;
    const Eigen::Vector3d from_prior(match.pose.x - predicted.x, match.pose.y - predicted.y,
                                     sarn::angleDifference(predicted.theta, match.pose.theta));
    Eigen::Vector3d gradient = prior * from_prior;
    match.log_likelihood = 0.0;
    for (const Eigen::Vector2d& end : ends) {
      const Eigen::Vector2d point = match.pose * end;
      const auto patch = patchAbout(grid, point, reach);
      double likelihood = kAnything;
      if (patch) {
        const Eigen::Matrix2d weight = acrossOnly(patch->covariance + noise).inverse();
        const Eigen::Vector2d residual = point - patch->mean;
        const double distance = residual.dot(weight * residual);
        likelihood += std::exp(-0.5 * distance);
        // Geman and McClure's kernel.
        const double fade = 1.0 / (1.0 + distance / (params.scale * params.scale));
        const double pull = params.exponent * fade * fade;
        Eigen::Matrix<double, 2, 3> jacobian;
        jacobian << 1.0, 0.0, -(point.y() - match.pose.y), 0.0, 1.0, point.x() - match.pose.x;
        information += pull * jacobian.transpose() * weight * jacobian;
        gradient += pull * jacobian.transpose() * weight * residual;
      }
      match.log_likelihood += std::log(likelihood);
    }
    match.covariance = information.inverse();
    if (i + 1 == kAll) break;  // the likelihood belongs to this pose
    const Eigen::Vector3d step = -match.covariance * gradient;
    match.pose = {match.pose.x + step.x(), match.pose.y + step.y(),
                  sarn::wrapAngle(match.pose.theta + step.z())};
    if (i >= kCoarse && step.cwiseAbs().maxCoeff() < kDone) break;
  }
  return match;
}

}  // namespace sarn_localization
