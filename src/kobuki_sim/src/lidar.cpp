// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kobuki_sim/body_shape.h"
#include "kobuki_sim/random.h"
#include "sarn_common/angles.h"
#include "sarn_common/parameters.h"

namespace kobuki_sim {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kFrameStride = 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio: seeds far apart

/// Distance [m] along a ray of this bearing from the origin to an ellipse; infinite when it misses, or when
/// the origin lies inside.
double rayToSlice(double bearing, const BodySlice& slice, double yaw) {
  const double c = std::cos(bearing - yaw);
  const double s = std::sin(bearing - yaw);
  // In axes along the ellipse's, scaled so that it is the unit circle about the origin.
  const Eigen::Vector2d center = sarn::Pose2D{0.0, 0.0, -yaw} * slice.center;
  const Eigen::Vector2d o(-center.x() / slice.along, -center.y() / slice.across);
  const Eigen::Vector2d d(c / slice.along, s / slice.across);
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double inside = b * b - a * (o.squaredNorm() - 1.0);
  if (inside < 0.0) return kNothing;
  const double t = (-b - std::sqrt(inside)) / a;
  return t > 0.0 ? t : kNothing;
}

}  // namespace

std::vector<std::string> LidarParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(range_min < range_max)) conflicts.emplace_back("range_min: must be less than range_max");
  return conflicts;
}

Lidar::Lidar(const LidarParams& params, std::uint64_t seed) : params_(params), seed_(seed) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("lidar: " + text);
  // The last beam of a full turn is the one before the first.
  const bool full = params.field_of_view > 2.0 * sarn::kPi - 1e-6;
  scan_.angle_min = -0.5 * params.field_of_view;
  scan_.angle_increment = params.field_of_view / (params.beams - (full ? 0.0 : 1.0));
  scan_.range_min = params.range_min;
  scan_.range_max = params.range_max;
}

void Lidar::castWalls(const StaticMap& map, const sarn::Pose2D& map_from_lidar) {
  range_.assign(static_cast<std::size_t>(params_.beams), kNothing);
  for (std::size_t i = 0; i < range_.size(); ++i) {
    const double angle = map_from_lidar.theta + bearing(i);
    const auto hit =
        map.rayCast(map_from_lidar.position(), {std::cos(angle), std::sin(angle)}, params_.range_max);
    if (hit) range_[i] = hit->distance;
  }
}

void Lidar::castPeople(const sarn::Pose2D& map_from_lidar, const std::vector<PersonState>& people) {
  const sarn::Pose2D lidar_from_map = sarn::inverse(map_from_lidar);
  for (const PersonState& person : people) {
    if (!person.present) continue;
    for (const BodyPart& in_map : walkingBody(person)) {
      if (params_.mount_z < in_map.bottom || params_.mount_z > in_map.top) continue;
      const BodyPart part = transformed(lidar_from_map, in_map);
      const BodySlice slice = part.at(params_.mount_z);
      const double distance = slice.center.norm();
      const double reach = std::max(slice.along, slice.across);
      if (distance - reach > params_.range_max) continue;
      const double middle = std::atan2(slice.center.y(), slice.center.x());
      const double half = distance > reach ? std::asin(reach / distance) : sarn::kPi;
      for (std::size_t i = 0; i < range_.size(); ++i) {
        if (std::abs(sarn::angleDifference(middle, bearing(i))) > half) continue;
        range_[i] = std::min(range_[i], rayToSlice(bearing(i), slice, part.yaw));
      }
    }
  }
}

void Lidar::corrupt(std::uint64_t frame) {
  RandomStream random(seed_ + kFrameStride * frame, "lidar");
  scan_.ranges.resize(range_.size());
  for (std::size_t i = 0; i < range_.size(); ++i) {
    // Drawn for each beam, so that one beam's fate never shifts another's noise.
    const double noise = params_.range_noise * random.normal();
    const bool dropped = random.uniform() < params_.drop_probability;
    const double range = dropped ? kNothing : range_[i] + noise;
    if (range > params_.range_max) {
      scan_.ranges[i] = std::numeric_limits<float>::infinity();
    } else if (range < params_.range_min) {
      scan_.ranges[i] = -std::numeric_limits<float>::infinity();
    } else {
      scan_.ranges[i] = static_cast<float>(range);
    }
  }
}

const LidarScan& Lidar::measure(const StaticMap& map, const sarn::Pose2D& map_from_base,
                                const std::vector<PersonState>& people, std::uint64_t frame) {
  const sarn::Pose2D map_from_lidar = map_from_base * baseFromLidar();
  castWalls(map, map_from_lidar);
  castPeople(map_from_lidar, people);
  corrupt(frame);
  return scan_;
}

}  // namespace kobuki_sim
