// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/body_detector.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sarn_common/angles.h"
#include "sarn_perception/checked_params.h"
#include "sarn_perception/depth_pixels.h"

namespace sarn_perception {
namespace {

constexpr std::size_t kNoCell = static_cast<std::size_t>(-1);
constexpr double kTorsoWidth = 0.35;   // [m] what a torso in full view is counted as
constexpr double kTorsoHeight = 0.30;  // [m]
constexpr double kCutSigma = 0.7;      // of what the image's edge cuts off: nobody is as wide as all
constexpr double kVisibleTop = 0.85;   // of the height that the view reaches: a person fills it

/// The lateral places [m] of a cluster's points between which the middle 96 % lie.
struct Extent {
  double left = 0.0;
  double right = 0.0;
};

struct Piece {
  double lateral = 0.0;  // [m] across the line of sight, left positive
  int count = 0;
};

Extent extentOf(std::vector<Piece> pieces) {
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.lateral < b.lateral; });
  const int all = std::accumulate(pieces.begin(), pieces.end(), 0,
                                  [](int sum, const Piece& piece) { return sum + piece.count; });
  const int tail = all / 50;
  Extent extent{pieces.back().lateral, pieces.front().lateral};
  int before = 0;
  for (const Piece& piece : pieces) {
    before += piece.count;
    if (before > tail) {
      extent.right = piece.lateral;
      break;
    }
  }
  before = 0;
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    before += piece->count;
    if (before > tail) {
      extent.left = piece->lateral;
      break;
    }
  }
  return extent;
}

}  // namespace

BodyDetector::BodyDetector(const BodyParams& params)
    : params_(checkedParams(params)),
      side_(2 * static_cast<int>(std::ceil(params.max_range / params.cell)) + 1),
      cells_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

BodyDetector::View BodyDetector::prepare(const PinholeCamera& camera,
                                         const Eigen::Isometry3d& base_from_optical, BodyView& result) const {
  View view;
  view.camera = camera;
  const Eigen::Vector3d eye = base_from_optical.translation();
  const Eigen::Vector3d ahead = base_from_optical.linear() * Eigen::Vector3d::UnitZ();
  const double yaw = std::atan2(ahead.y(), ahead.x());
  result.base_from_camera = {eye.x(), eye.y(), yaw};
  Eigen::Isometry3d base_from_level = Eigen::Isometry3d::Identity();
  base_from_level.translate(Eigen::Vector3d(eye.x(), eye.y(), 0.0));
  base_from_level.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  view.level_from_optical = base_from_level.inverse() * base_from_optical;
  const Eigen::Vector3d top =
      view.level_from_optical.linear() * Eigen::Vector3d(0.0, -camera.cy / camera.fy, 1.0);
  view.top_slope = top.x() > 0.0 ? top.z() / top.x() : 0.0;
  view.eye_height = eye.z();
  return view;
}

std::size_t BodyDetector::cellOf(const Eigen::Vector3f& point) const {
  const auto cell = static_cast<float>(params_.cell);
  const int middle = side_ / 2;
  const int x = static_cast<int>(std::floor(point.x() / cell + 0.5F)) + middle;
  const int y = static_cast<int>(std::floor(point.y() / cell + 0.5F)) + middle;
  if (x < 0 || y < 0 || x >= side_ || y >= side_) return kNoCell;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
}

void BodyDetector::drop(const DepthImageView& image, const View& view, RangeProfile& profile) {
  for (const std::size_t cell : filled_) cells_[cell] = {};
  filled_.clear();
  const PinholeCamera& camera = view.camera;
  const Eigen::Matrix3f rotation = view.level_from_optical.linear().cast<float>();
  const Eigen::Vector3f origin = view.level_from_optical.translation().cast<float>();
  const auto min_height = static_cast<float>(params_.min_height);
  const auto max_height = static_cast<float>(params_.max_height);
  const auto max_range = static_cast<float>(params_.max_range);
  for (int v = params_.stride / 2; v < image.height; v += params_.stride) {
    const auto y = static_cast<float>((v - camera.cy) / camera.fy);
    for (int u = params_.stride / 2; u < image.width; u += params_.stride) {
      const float depth = depthAt(image, u, v);
      if (depth == 0.0F) continue;
      const auto x = static_cast<float>((u - camera.cx) / camera.fx);
      const Eigen::Vector3f point = rotation * Eigen::Vector3f(x * depth, y * depth, depth) + origin;
      if (point.z() < min_height) continue;
      const float range = std::hypot(point.x(), point.y());
      const double turn = (static_cast<double>(std::atan2(point.y(), point.x())) - profile.angle_min) /
                          profile.angle_increment;
      if (turn > -0.5 && turn < static_cast<double>(profile.ranges.size()) - 0.5) {
        float& nearest = profile.ranges[static_cast<std::size_t>(std::lround(turn))];
        nearest = std::isnan(nearest) ? range : std::min(nearest, range);
      }
      if (point.z() > max_height || range > max_range) continue;
      const std::size_t index = cellOf(point);
      if (index == kNoCell) continue;
      Cell& cell = cells_[index];
      if (cell.count == 0) filled_.push_back(index);
      ++cell.count;
      cell.sum += point.head<2>();
      cell.top = std::max(cell.top, point.z());
    }
  }
}

void BodyDetector::removeBackground(const Background& background, const sarn::Pose2D& map_from_camera) {
  for (const std::size_t index : filled_) {
    Cell& cell = cells_[index];
    const Eigen::Vector2d mean = (cell.sum / static_cast<float>(cell.count)).cast<double>();
    const double range = mean.norm();
    if (background.explains(map_from_camera * mean, range, noise(range))) cell.count = 0;
  }
}

std::vector<std::vector<std::size_t>> BodyDetector::clusters() {
  std::vector<std::vector<std::size_t>> clusters;
  std::vector<bool> open(cells_.size(), false);
  for (const std::size_t index : filled_) open[index] = cells_[index].count > 0;
  const auto side = static_cast<std::size_t>(side_);
  for (const std::size_t seed : filled_) {
    if (!open[seed]) continue;
    open[seed] = false;
    std::vector<std::size_t> cluster{seed};
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const int x = static_cast<int>(cluster[i] % side);
      const int y = static_cast<int>(cluster[i] / side);
      const double range = params_.cell * std::hypot(x - side_ / 2, y - side_ / 2);
      const int reach = std::max(
          1, static_cast<int>(std::lround((params_.connection + 2.0 * noise(range)) / params_.cell)));
      for (int ny = std::max(0, y - reach); ny <= std::min(side_ - 1, y + reach); ++ny) {
        for (int nx = std::max(0, x - reach); nx <= std::min(side_ - 1, x + reach); ++nx) {
          const std::size_t next = static_cast<std::size_t>(ny) * side + static_cast<std::size_t>(nx);
          if (!open[next]) continue;
          open[next] = false;
          cluster.push_back(next);
        }
      }
    }
    clusters.push_back(std::move(cluster));
  }
  return clusters;
}

double BodyDetector::cutOff(const Eigen::Vector2d& seen, const PinholeCamera& camera) {
  const double bearing = std::atan2(seen.y(), seen.x());
  const double left = (camera.bearing_left - bearing) * seen.norm();
  const double right = (bearing - camera.bearing_right) * seen.norm();
  const double missing = std::clamp(0.5 * kTorsoWidth - std::min(left, right), 0.0, 0.5 * kTorsoWidth);
  return left < right ? missing : -missing;
}

void BodyDetector::addBodies(const std::vector<std::size_t>& cluster, const View& view,
                             const Background& background, const sarn::Pose2D& map_from_camera,
                             std::vector<Body>& bodies) const {
  Cell all;
  for (const std::size_t index : cluster) {
    all.count += cells_[index].count;
    all.sum += cells_[index].sum;
    all.top = std::max(all.top, cells_[index].top);
  }
  const Eigen::Vector2d middle = (all.sum / static_cast<float>(all.count)).cast<double>();
  const double range = middle.norm();
  if (!(range > 0.0)) return;
  const double highest = view.eye_height + view.top_slope * range;  // [m] that is in view there
  if (static_cast<double>(all.top) < std::min(params_.min_top, kVisibleTop * highest)) return;
  const Eigen::Vector2d across(-middle.y() / range, middle.x() / range);
  std::vector<Piece> pieces;
  pieces.reserve(cluster.size());
  for (const std::size_t index : cluster) {
    const Eigen::Vector2d mean = (cells_[index].sum / static_cast<float>(cells_[index].count)).cast<double>();
    pieces.push_back({across.dot(mean), cells_[index].count});
  }
  const Extent extent = extentOf(pieces);
  const double width = extent.left - extent.right + params_.cell;
  if (width < params_.min_width || width > params_.max_cluster_width) return;
  const int parts = std::max(1, static_cast<int>(std::ceil(width / params_.max_width)));
  const double pitch = params_.stride * range / view.camera.fx;  // [m] between pixels there
  const double in_view = std::clamp(highest - params_.min_height, 0.0, kTorsoHeight);
  const double expected = kTorsoWidth * in_view / (pitch * pitch);
  for (int part = 0; part < parts; ++part) {
    Cell own;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const double place = (pieces[i].lateral - extent.right + 0.5 * params_.cell) / width * parts;
      if (std::clamp(static_cast<int>(place), 0, parts - 1) != part) continue;
      own.count += cells_[cluster[i]].count;
      own.sum += cells_[cluster[i]].sum;
    }
    if (own.count < 4 || own.count < params_.min_share * expected) continue;
    const Eigen::Vector2d front = (own.sum / static_cast<float>(own.count)).cast<double>();
    Body body;
    body.position = front * (1.0 + params_.depth_offset / front.norm());
    const double outside = cutOff(body.position, view.camera);
    body.position += outside * across;
    body.sigma = std::hypot(0.5 * noise(range), kCutSigma * std::abs(outside));
    body.confidence = parts == 1 ? 1.0 : 0.5;
    if (background.unknown(map_from_camera * body.position)) body.confidence *= params_.unknown_confidence;
    bodies.push_back(body);
  }
}

BodyView BodyDetector::detect(const DepthImageView& image, const CameraCalibration& calibration,
                              const Eigen::Isometry3d& base_from_optical, const Background& background,
                              const sarn::Pose2D& map_from_base) {
  checkDepthImage(image);
  const PinholeCamera camera = pinholeCamera(calibration, image.width, image.height);
  BodyView result;
  const View view = prepare(camera, base_from_optical, result);
  const auto columns = static_cast<std::size_t>(std::max(2, image.width / params_.stride));
  result.profile.angle_min = camera.bearing_right;
  result.profile.angle_increment =
      (camera.bearing_left - camera.bearing_right) / static_cast<double>(columns - 1);
  result.profile.max_range = params_.max_range;
  result.profile.ranges.assign(columns, std::nanf(""));
  drop(image, view, result.profile);

  std::vector<SeenPoint> walls;
  for (std::size_t i = 0; i < columns; ++i) {
    const auto range = static_cast<double>(result.profile.ranges[i]);
    if (std::isnan(range)) continue;
    const double bearing = result.profile.angle_min + static_cast<double>(i) * result.profile.angle_increment;
    walls.push_back({{range * std::cos(bearing), range * std::sin(bearing)}, noise(range)});
  }
  const sarn::Pose2D fitted = background.fit(walls, map_from_base * result.base_from_camera);
  removeBackground(background, fitted);
  for (const auto& cluster : clusters()) {
    addBodies(cluster, view, background, fitted, result.bodies);
  }
  for (Body& body : result.bodies) body.position = result.base_from_camera * body.position;
  return result;
}

}  // namespace sarn_perception
