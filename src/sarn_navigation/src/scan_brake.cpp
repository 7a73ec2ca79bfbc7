// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/scan_brake.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_navigation/swept_corridor.h"

namespace sarn_navigation {
namespace {

constexpr int kCoarseSteps = 20;      // shares of the wanted speed that are tried
constexpr int kBisections = 12;       // halvings between the best of them and the next
constexpr double kNoticeable = 1e-3;  // [m/s] smaller differences are not braking

using Points = std::vector<Eigen::Vector2d>;

bool stopsInTime(const sarn::Twist2D& twist, const Points& points, const ScanBrakeParams& params) {
  if (twist.v == 0.0) return true;
  const double needed =
      stoppingDistance(twist.v, params.reaction_time, params.deceleration) + params.stop_margin;
  const double radius = params.robot_radius + params.margin;
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector2d& p) { return freeDistance(twist, p, radius) >= needed; });
}

/// Points that the robot could touch before it stands.
Points withinReach(const Points& points, double speed, const ScanBrakeParams& params) {
  const double reach = stoppingDistance(speed, params.reaction_time, params.deceleration) +
                       params.stop_margin + params.robot_radius + params.margin;
  Points near;
  std::copy_if(points.begin(), points.end(), std::back_inserter(near),
               [&](const Eigen::Vector2d& p) { return p.squaredNorm() <= reach * reach; });
  return near;
}

sarn::Twist2D scaled(const sarn::Twist2D& twist, double share) { return {share * twist.v, twist.omega}; }

}  // namespace

sarn::Twist2D limitToFreeSpace(const sarn::Twist2D& wanted, const Points& points,
                               const ScanBrakeParams& params) {
  const Points near = withinReach(points, wanted.v, params);
  if (stopsInTime(wanted, near, params)) return wanted;
  // The arc changes with the share, so a smaller share need not be safer everywhere: search from above.
  int best = kCoarseSteps - 1;
  while (best > 0 && !stopsInTime(scaled(wanted, best / static_cast<double>(kCoarseSteps)), near, params))
    --best;
  double safe = best / static_cast<double>(kCoarseSteps);
  double unsafe = (best + 1) / static_cast<double>(kCoarseSteps);
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (safe + unsafe);
    (stopsInTime(scaled(wanted, middle), near, params) ? safe : unsafe) = middle;
  }
  if (std::abs(safe * wanted.v) < kNoticeable) safe = 0.0;
  return scaled(wanted, safe);
}

ScanBrake::ScanBrake(const ScanBrakeParams& params)
    : params_(params),
      memory_(
          {params.memory_time, params.near_memory_time, params.memory_radius, params.silent_memory_time}) {}

void ScanBrake::insertScan(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp) {
  memory_.insert(scan, odom_from_sensor, stamp);
  scan_time_ = stamp;
}

BrakeDecision ScanBrake::limit(const sarn::Twist2D& wanted, const std::optional<sarn::Pose2D>& odom_from_base,
                               double now) const {
  if (!scan_time_) return {{}, BrakeReason::kNoScan};
  if (now - *scan_time_ > params_.scan_timeout) return {{}, BrakeReason::kOldScan};
  if (!odom_from_base) return {{}, BrakeReason::kNoPose};
  const sarn::Twist2D twist = limitToFreeSpace(wanted, memory_.pointsAround(*odom_from_base), params_);
  const bool limited = std::abs(wanted.v) - std::abs(twist.v) > kNoticeable;
  return {twist, limited ? BrakeReason::kObstacle : BrakeReason::kNone};
}

void ScanBrake::reset() {
  memory_.clear();
  scan_time_.reset();
}

}  // namespace sarn_navigation
