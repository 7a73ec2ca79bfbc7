// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn_navigation {

/// A planar scan in plain values.
struct Scan {
  double angle_min = 0.0;        // [rad] of the first beam, in the sensor's frame
  double angle_increment = 0.0;  // [rad], not zero
  double range_min = 0.0;        // [m]
  double range_max = 0.0;        // [m]
  std::vector<double> ranges;    // [m]
};

enum class BeamKind { kUnknown, kFree, kHit };

struct Beam {
  BeamKind kind = BeamKind::kUnknown;
  double range = 0.0;  // [m] up to which the beam is free
};

/// What one range says (REP-117): NaN, zero and finite values below range_min are no information; +Inf and
/// values above range_max are free up to range_max; -Inf is something too close to measure, taken to be at
/// range_min.
[[nodiscard]] Beam interpretBeam(double range, double range_min, double range_max);

struct ObstacleMemoryParams {
  double memory_time = 2.0;        // [s] an obstacle outside the view is remembered
  double near_memory_time = 60.0;  // [s] an obstacle within the view but nearer than the sensor can see
  double memory_radius = 2.0;      // [m] from the robot; what is further away is forgotten
  double silent_memory_time =
      0.6;  // [s] an obstacle within the view and range where nothing returns any more
};

/// Recent scan returns in the odom frame, one per cell of 5 cm.
///
/// A depth camera sees 58 degrees and nothing nearer than 0.45 m, while what stops the robot is mostly beside
/// or close in front of it. A return that leaves the view is therefore remembered for a while; one that a
/// later beam looks through is dropped at once. Where nothing is within range behind it, no beam can look
/// through: a depth camera gives NaN there, as it may for a moment on black trousers, so that such a return
/// is dropped after a short while.
class ObstacleMemory {
 public:
  explicit ObstacleMemory(const ObstacleMemoryParams& params) : params_(params) {}

  /// Takes a scan made at `stamp` [s] with the sensor at `odom_from_sensor`.
  void insert(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp);
  /// Remembered returns in the frame of a robot at `odom_from_base`.
  [[nodiscard]] std::vector<Eigen::Vector2d> pointsAround(const sarn::Pose2D& odom_from_base) const;
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  void clear() { points_.clear(); }

 private:
  struct Remembered {
    Eigen::Vector2d position;  // [m] in odom
    double seen = 0.0;         // [s] when a beam last hit it
    double expires = 0.0;      // [s]
  };
  enum class Verdict { kKeep, kKeepNear, kSilent, kDrop };
  [[nodiscard]] static Verdict judge(const Scan& scan, const Eigen::Vector2d& in_sensor);
  void forget(const Scan& scan, const sarn::Pose2D& odom_from_sensor, double stamp);

  ObstacleMemoryParams params_;
  std::unordered_map<std::uint64_t, Remembered> points_;  // by cell
};

}  // namespace sarn_navigation
