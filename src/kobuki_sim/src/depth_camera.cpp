// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/depth_camera.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "sarn_common/parameters.h"

namespace kobuki_sim {
namespace {

constexpr float kLargestInverseDepth = 1e3F;  // [1/m] of what touches the lens

const DepthCameraParams& checked(const DepthCameraParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("depth camera: " + text);
  return params;
}

/// First wall on a ray, as StaticMap::rayCast, but with long steps through open space.
std::optional<RayHit> castFar(const StaticMap& map, const Eigen::Vector2d& origin,
                              const Eigen::Vector2d& direction, double max_range) {
  constexpr double kWorthwhile = 4.0;   // [cells] a long step is taken from
  constexpr double kExactCells = 16.0;  // [cells] walked one by one otherwise
  constexpr double kOverlap = 1e-6;     // [m] so that no walk begins inside a wall that the last one ended at
  if (map.empty()) return std::nullopt;
  const double cell = map.geometry().resolution;
  for (double t = 0.0; t < max_range;) {
    const Eigen::Vector2d from = origin + t * direction;
    const double clearance = map.clearanceLowerBound(from);
    if (clearance > kWorthwhile * cell) {
      t += clearance;
      continue;
    }
    auto hit = map.rayCast(from, direction, kExactCells * cell);
    if (hit) {
      hit->distance += t;
      return hit;
    }
    t += kExactCells * cell - kOverlap;
  }
  return std::nullopt;
}

}  // namespace

DepthCamera::DepthCamera(const DepthCameraParams& params, std::uint64_t seed)
    : params_(checked(params)), noise_(params, seed) {
  const auto width = static_cast<std::size_t>(params.width);
  image_ = {params.width, params.height, {}};
  image_.millimetres.resize(width * static_cast<std::size_t>(params.height));
  for (auto* row : {&column_slope_, &wall_, &wall_loss_, &row_, &row_loss_}) row->resize(width);
  for (int u = 0; u < params.width; ++u) {
    column_slope_[static_cast<std::size_t>(u)] = static_cast<float>((params.cx - u) / params.fx);
  }
}

const DepthImage& DepthCamera::render(const StaticMap& map, const sarn::Pose2D& map_from_base,
                                      const std::vector<PersonState>& people, std::uint64_t frame) {
  const sarn::Pose2D map_from_camera = map_from_base * sarn::Pose2D{params_.mount_x, params_.mount_y, 0.0};
  castWalls(map, map_from_camera);
  addBodies(map_from_camera, people);
  std::uint16_t* out = image_.millimetres.data();
  for (int v = 0; v < params_.height; ++v, out += params_.width) {
    renderBackground(v);
    renderBodies(v);
    if (params_.shadows) noise_.castShadows(row_.data(), row_loss_.data());
    noise_.corrupt(row_.data(), row_loss_.data(), frame, v, out);
  }
  return image_;
}

void DepthCamera::castWalls(const StaticMap& map, const sarn::Pose2D& map_from_camera) {
  const Eigen::Vector2d ahead(std::cos(map_from_camera.theta), std::sin(map_from_camera.theta));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  for (std::size_t u = 0; u < column_slope_.size(); ++u) {
    const double slope = column_slope_[u];
    const double length = std::sqrt(1.0 + slope * slope);  // [m] of the ray a metre of depth
    const Eigen::Vector2d direction = (ahead + slope * left) / length;
    // Noise may bring a wall just out of range into it.
    const auto hit = castFar(map, map_from_camera.position(), direction, 1.1 * params_.range_max * length);
    wall_[u] = hit ? std::min(kLargestInverseDepth, static_cast<float>(length / hit->distance)) : 0.0F;
    const double cos_incidence = hit ? std::abs(direction.dot(hit->normal)) : 1.0;
    wall_loss_[u] = static_cast<float>(lossProbability(params_, cos_incidence));
  }
}

void DepthCamera::addBodies(const sarn::Pose2D& map_from_camera, const std::vector<PersonState>& people) {
  constexpr double kReach = 1.0;  // [m] no part of a body is farther from its centre
  const sarn::Pose2D camera_from_map = sarn::inverse(map_from_camera);
  parts_.clear();
  for (const PersonState& person : people) {
    const Eigen::Vector2d center = camera_from_map * person.position;
    const bool near = center.x() > -kReach && center.x() < params_.range_max + kReach;
    if (!person.present || !near) continue;
    for (const BodyPart& part : walkingBody(person)) {
      parts_.push_back(transformed(camera_from_map, part));
    }
  }
}

void DepthCamera::renderBackground(int row) {
  const double down = (row - params_.cy) / params_.fy;  // [m] a metre of depth
  if (down <= 0.0) {
    // Above the horizon: walls, unless the ray passes over them.
    const auto over = static_cast<float>(-down / (params_.wall_height - params_.mount_z));
    for (std::size_t u = 0; u < row_.size(); ++u) row_[u] = wall_[u] >= over ? wall_[u] : 0.0F;
    std::copy(wall_loss_.begin(), wall_loss_.end(), row_loss_.begin());
    return;
  }
  const auto floor = static_cast<float>(down / params_.mount_z);
  const auto floor_loss = static_cast<float>(lossProbability(params_, down / std::sqrt(1.0 + down * down)));
  for (std::size_t u = 0; u < row_.size(); ++u) {
    row_[u] = std::max(wall_[u], floor);
    row_loss_[u] = wall_[u] > floor ? wall_loss_[u] : floor_loss;
  }
}

void DepthCamera::renderBodies(int row) {
  const double up = (params_.cy - row) / params_.fy;  // [m] a metre of depth
  for (const BodyPart& part : parts_) {
    // The height at which the row meets the part's axis: h = mount_z + up * x(h), with x linear in h.
    const double lean = (part.upper.center.x() - part.lower.center.x()) / (part.top - part.bottom);
    const double base = part.lower.center.x() - lean * part.bottom;
    const double height = (params_.mount_z + up * base) / (1.0 - up * lean);
    if (!(height >= part.bottom && height <= part.top)) continue;
    const auto view = viewSlice(part.at(height), part.yaw);
    if (view) drawSlice(*view);
  }
}

void DepthCamera::drawSlice(const SliceView& view) {
  // Columns run against the slope.
  const double first = params_.cx - params_.fx * static_cast<double>(view.slope_max);
  const double last = params_.cx - params_.fx * static_cast<double>(view.slope_min);
  if (!(last >= 0.0 && first <= params_.width - 1)) return;
  const int begin = std::max(0, static_cast<int>(std::ceil(first)));
  const int end = std::min(params_.width - 1, static_cast<int>(std::floor(last)));
  for (int u = begin; u <= end; ++u) {
    const auto i = static_cast<std::size_t>(u);
    const float m = column_slope_[i];
    const float d = std::max(0.0F, view.curvature * (m - view.slope_min) * (view.slope_max - m));
    const float w = (std::sqrt(d) - (view.b0 + view.b1 * m)) * view.inverse_c;
    if (w <= row_[i]) continue;
    row_[i] = w;
    const float cos_squared = d / (view.a0 + (view.a1 + view.a2 * m) * m);
    row_loss_[i] = static_cast<float>(lossProbability(params_, std::sqrt(static_cast<double>(cos_squared))));
  }
}

}  // namespace kobuki_sim
