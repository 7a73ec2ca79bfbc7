// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_navigation/obstacle_memory.h"

namespace sarn_navigation {

struct ScanBrakeParams {
  double robot_radius = 0.18;  // [m] of the disc that holds the robot
  double margin = 0.02;        // [m] kept free around the disc along the whole corridor
  double stop_margin = 0.05;   // [m] kept free, besides, between the stopped robot and what it stopped for
  double reaction_time =
      0.25;  // [s] from a return to the base's brake: exposure, transport, smoother, command delay
  double deceleration = 0.8;       // [m/s^2] that the base can be relied on; below the smoother's decel limit
  double memory_time = 2.0;        // [s] returns outside the view are remembered
  double near_memory_time = 60.0;  // [s] the same for what is in the view, but nearer than range_min
  double memory_radius = 2.0;      // [m] around the sensor
  double silent_memory_time =
      0.6;                    // [s] the same for what is in the view and within range, where nothing returns
  double scan_timeout = 0.5;  // [s] an older scan makes the robot stand still; the same for odometry
  double command_timeout = 0.5;  // [s] after which the last command no longer counts

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("robot_radius", p.robot_radius, {0.01, 2.0});
    v("margin", p.margin, {0.0, 1.0});
    v("stop_margin", p.stop_margin, {0.0, 1.0});
    v("reaction_time", p.reaction_time, {0.0, 5.0});
    v("deceleration", p.deceleration, {0.05, 10.0});
    v("memory_time", p.memory_time, {0.0, 60.0});
    v("near_memory_time", p.near_memory_time, {0.0, 300.0});
    v("memory_radius", p.memory_radius, {0.5, 20.0});
    v("silent_memory_time", p.silent_memory_time, {0.0, 60.0});
    v("scan_timeout", p.scan_timeout, {0.01, 10.0});
    v("command_timeout", p.command_timeout, {0.01, 10.0});
  }
};

enum class BrakeReason { kNone, kObstacle, kNoScan, kOldScan, kNoPose };

struct BrakeDecision {
  sarn::Twist2D twist;
  BrakeReason reason = BrakeReason::kNone;
  [[nodiscard]] bool braking() const { return reason != BrakeReason::kNone; }
};

/// The command of least change to `wanted` that stops in front of every point (base_footprint): omega stays,
/// v shrinks to the largest for which the stopping distance along its own arc is at most the free distance
/// minus stop_margin, down to turning in place.
[[nodiscard]] sarn::Twist2D limitToFreeSpace(const sarn::Twist2D& wanted,
                                             const std::vector<Eigen::Vector2d>& points,
                                             const ScanBrakeParams& params);

/// Limits velocity commands by what the range sensor sees, independent of any map, people tracker or planner.
///
/// It is blind where the sensor was not looking within memory_time: behind and beside the robot, and above
/// and below the scan's plane. A command without forward or backward speed passes unless the sensor is
/// silent.
class ScanBrake {
 public:
  explicit ScanBrake(const ScanBrakeParams& params);

  /// A scan made at `stamp` [s]; both poses in odom at that time.
  void insertScan(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp);

  /// What may be sent at `now` [s] instead of `wanted`, for a robot at `odom_from_base` (nothing: pose
  /// unknown). Stands still without a fresh scan or without a pose.
  [[nodiscard]] BrakeDecision limit(const sarn::Twist2D& wanted,
                                    const std::optional<sarn::Pose2D>& odom_from_base, double now) const;

  /// Forgets every scan (the clock jumped back).
  void reset();

 private:
  ScanBrakeParams params_;
  ObstacleMemory memory_;
  std::optional<double> scan_time_;  // [s] of the latest scan
};

}  // namespace sarn_navigation
