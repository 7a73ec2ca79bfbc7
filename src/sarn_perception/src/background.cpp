// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/background.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"
#include "sarn_common/distance_transform.h"
#include "sarn_perception/checked_params.h"

namespace sarn_perception {
namespace {

constexpr int kSteps = 24;               // of Gauss and Newton
constexpr double kFirstScale = 4.0;      // of align_scale; halved with each step
constexpr double kTurn = 0.75;           // of align_sigma_theta: headings that the fit starts from too
constexpr std::size_t kFitPoints = 160;  // are enough for three numbers
constexpr double kConverged = 1e-4;      // [m], [rad]

/// Every so many points are enough for a fit.
std::size_t strideOf(const std::vector<SeenPoint>& points) {
  return std::max<std::size_t>(1, points.size() / kFitPoints);
}

/// (x, y, theta) of a pose from the prior one.
Eigen::Vector3d offsetOf(const sarn::Pose2D& prior, const sarn::Pose2D& pose) {
  return {pose.x - prior.x, pose.y - prior.y, sarn::angleDifference(prior.theta, pose.theta)};
}

Eigen::Vector3d priorInformation(const BackgroundParams& params) {
  const Eigen::Array3d sigma(params.align_sigma_xy, params.align_sigma_xy, params.align_sigma_theta);
  return sigma.square().inverse().matrix();
}

}  // namespace

Background::Background(const BackgroundParams& params) : params_(checkedParams(params)) {}

void Background::setMap(const sarn::OccupancyMap& map) {
  map_ = map;
  sarn::Grid<std::uint8_t> occupied(map.geometry, 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    occupied.cells[i] = map.cells[i] == sarn::kMapOccupied ? 1 : 0;
  }
  distance_ = sarn::distanceTransform(occupied);
  // Between centres -> to the wall's edge.
  const auto half = static_cast<float>(0.5 * map.geometry.resolution);
  for (float& d : distance_.cells) d = std::clamp(d - half, 0.0F, static_cast<float>(kReach));
}

double Background::cellDistance(const sarn::CellIndex& cell) const {
  return distance_.geometry.contains(cell) ? static_cast<double>(distance_.at(cell)) : kReach;
}

Background::Slope Background::slope(const Eigen::Vector2d& point) const {
  const sarn::GridGeometry& grid = distance_.geometry;
  if (!grid.cellAt(point.x(), point.y())) return {kReach, Eigen::Vector2d::Zero()};
  // Bilinear between the centres of the four cells around.
  const double column = (point.x() - grid.origin_x) / grid.resolution - 0.5;
  const double row = (point.y() - grid.origin_y) / grid.resolution - 0.5;
  const int x = static_cast<int>(std::floor(column));
  const int y = static_cast<int>(std::floor(row));
  const double fx = column - x;
  const double fy = row - y;
  const double d00 = cellDistance({x, y});
  const double d10 = cellDistance({x + 1, y});
  const double d01 = cellDistance({x, y + 1});
  const double d11 = cellDistance({x + 1, y + 1});
  Slope result;
  result.distance = (1.0 - fy) * ((1.0 - fx) * d00 + fx * d10) + fy * ((1.0 - fx) * d01 + fx * d11);
  result.gradient = Eigen::Vector2d((1.0 - fy) * (d10 - d00) + fy * (d11 - d01),
                                    (1.0 - fx) * (d01 - d00) + fx * (d11 - d10)) /
                    grid.resolution;
  return result;
}

double Background::wallDistance(const Eigen::Vector2d& point) const {
  return hasMap() ? slope(point).distance : kReach;
}

bool Background::explains(const Eigen::Vector2d& point, double range, double sigma) const {
  return wallDistance(point) <
         params_.tolerance + params_.tolerance_per_m * range + params_.noise_factor * sigma;
}

bool Background::unknown(const Eigen::Vector2d& point) const {
  const auto cell = map_.geometry.cellAt(point.x(), point.y());
  return !hasMap() || !cell || map_.at(*cell) == sarn::kMapUnknown;
}

double Background::misfit(const std::vector<SeenPoint>& points, const sarn::Pose2D& prior,
                          const sarn::Pose2D& pose) const {
  const Eigen::Vector3d offset = offsetOf(prior, pose);
  double sum = 0.5 * priorInformation(params_).cwiseProduct(offset).dot(offset);
  for (std::size_t i = 0; i < points.size(); i += strideOf(points)) {
    const double ratio =
        slope(pose * points[i].position).distance / std::hypot(params_.align_scale, points[i].sigma);
    sum += 0.5 * ratio * ratio / (1.0 + ratio * ratio);
  }
  return sum;
}

sarn::Pose2D Background::refine(const std::vector<SeenPoint>& points, const sarn::Pose2D& prior,
                                const sarn::Pose2D& start, double widening) const {
  const Eigen::Vector3d prior_information = priorInformation(params_);
  sarn::Pose2D pose = start;
  for (int step = 0; step < kSteps; ++step, widening = std::max(1.0, 0.5 * widening)) {
    Eigen::Matrix3d information = prior_information.asDiagonal();
    Eigen::Vector3d pull = -prior_information.cwiseProduct(offsetOf(prior, pose));
    for (std::size_t i = 0; i < points.size(); i += strideOf(points)) {
      const Eigen::Vector2d place = pose * points[i].position;
      const Slope wall = slope(place);
      const double scale = std::hypot(widening * params_.align_scale, points[i].sigma);
      const double ratio = wall.distance / scale;
      const double weight = 1.0 / (scale * scale * (1.0 + ratio * ratio) * (1.0 + ratio * ratio));
      const Eigen::Vector2d arm = place - pose.position();
      const Eigen::Vector3d jacobian(wall.gradient.x(), wall.gradient.y(),
                                     wall.gradient.y() * arm.x() - wall.gradient.x() * arm.y());
      information += weight * jacobian * jacobian.transpose();
      pull -= weight * wall.distance * jacobian;
    }
    const Eigen::Vector3d move = information.ldlt().solve(pull);
    if (!move.allFinite()) return prior;
    pose = {pose.x + move.x(), pose.y + move.y(), sarn::wrapAngle(pose.theta + move.z())};
    if (widening == 1.0 && move.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return pose;
}

sarn::Pose2D Background::fit(const std::vector<SeenPoint>& points,
                             const sarn::Pose2D& map_from_sensor) const {
  if (!params_.align || !hasMap() || points.empty()) return map_from_sensor;
  sarn::Pose2D best = refine(points, map_from_sensor, map_from_sensor, kFirstScale);
  double least = misfit(points, map_from_sensor, best);
  for (const double turn : {-kTurn, kTurn}) {
    sarn::Pose2D start = map_from_sensor;
    start.theta += turn * params_.align_sigma_theta;
    const sarn::Pose2D pose = refine(points, map_from_sensor, start, 1.0);
    const double cost = misfit(points, map_from_sensor, pose);
    if (!(cost < least)) continue;
    least = cost;
    best = pose;
  }
  return best;
}

}  // namespace sarn_perception
