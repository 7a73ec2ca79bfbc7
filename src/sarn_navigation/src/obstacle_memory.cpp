// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/obstacle_memory.h"

#include <algorithm>
#include <cmath>

namespace sarn_navigation {
namespace {

constexpr double kCell = 0.05;           // [m]
constexpr double kSeeThroughGap = 0.10;  // [m] a beam must reach beyond a point to prove that it is gone
constexpr int kNeighbourBeams = 2;       // beams on each side that are asked about a point

std::uint64_t cellOf(const Eigen::Vector2d& p) {
  const auto x = static_cast<std::int32_t>(std::floor(p.x() / kCell));
  const auto y = static_cast<std::int32_t>(std::floor(p.y() / kCell));
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) | static_cast<std::uint32_t>(y);
}

}  // namespace

Beam interpretBeam(double range, double range_min, double range_max) {
  if (std::isnan(range)) return {};
  if (std::isinf(range))
    return range > 0.0 ? Beam{BeamKind::kFree, range_max} : Beam{BeamKind::kHit, range_min};
  if (range <= 0.0 || range < range_min) return {};
  if (range > range_max) return {BeamKind::kFree, range_max};
  return {BeamKind::kHit, range};
}

ObstacleMemory::Verdict ObstacleMemory::judge(const Scan& scan, const Eigen::Vector2d& in_sensor) {
  const double distance = in_sensor.norm();
  const double bearing = std::atan2(in_sensor.y(), in_sensor.x());
  const double beam = (bearing - scan.angle_min) / scan.angle_increment;
  const double last_beam = static_cast<double>(scan.ranges.size()) - 1.0;
  if (!(beam >= 0.0 && beam <= last_beam)) return Verdict::kKeep;
  const int centre = static_cast<int>(std::lround(beam));
  bool looked = false;
  double nearest = scan.range_max;
  for (int i = centre - kNeighbourBeams; i <= centre + kNeighbourBeams; ++i) {
    if (i < 0 || i > static_cast<int>(last_beam)) continue;
    const Beam seen = interpretBeam(scan.ranges[static_cast<std::size_t>(i)], scan.range_min, scan.range_max);
    if (seen.kind == BeamKind::kUnknown) continue;
    looked = true;
    nearest = std::min(nearest, seen.range);
  }
  if (looked && nearest > distance + kSeeThroughGap) return Verdict::kDrop;
  if (looked) return Verdict::kKeep;
  return distance < scan.range_min + kSeeThroughGap ? Verdict::kKeepNear : Verdict::kSilent;
}

void ObstacleMemory::forget(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp) {
  const sarn::Pose2D sensor_from_odom = sarn::inverse(odom_from_sensor);
  for (auto it = points_.begin(); it != points_.end();) {
    Remembered& point = it->second;
    const Eigen::Vector2d in_sensor = sensor_from_odom * point.position;
    const Verdict verdict = judge(scan, in_sensor);
    const bool far = in_sensor.norm() > params_.memory_radius;
    if (verdict == Verdict::kKeepNear) {
      const double latest = point.seen + params_.near_memory_time;
      point.expires = std::max(point.expires, std::min(latest, stamp + params_.memory_time));
    } else if (verdict == Verdict::kSilent) {
      point.expires = std::min(point.expires, point.seen + params_.silent_memory_time);
    }
    it = verdict == Verdict::kDrop || far || stamp > point.expires ? points_.erase(it) : std::next(it);
  }
}

void ObstacleMemory::insert(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp) {
  forget(scan, odom_from_sensor, stamp);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const Beam beam = interpretBeam(scan.ranges[i], scan.range_min, scan.range_max);
    if (beam.kind != BeamKind::kHit || beam.range > params_.memory_radius) continue;
    const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    const Eigen::Vector2d in_sensor(beam.range * std::cos(angle), beam.range * std::sin(angle));
    const Eigen::Vector2d in_odom = odom_from_sensor * in_sensor;
    points_[cellOf(in_odom)] = {in_odom, stamp, stamp + params_.memory_time};
  }
}

std::vector<Eigen::Vector2d> ObstacleMemory::pointsAround(const sarn::Pose2D& odom_from_base) const {
  const sarn::Pose2D base_from_odom = sarn::inverse(odom_from_base);
  std::vector<Eigen::Vector2d> result;
  result.reserve(points_.size());
  for (const auto& entry : points_) result.push_back(base_from_odom * entry.second.position);
  return result;
}

}  // namespace sarn_navigation
