// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>

#include "sarn_common/pose2d.h"
#include "sarn_localization/scan_beams.h"

namespace sarn_localization {

/// What the robot saw on the last stretch of its way, held together by the odometry: a local map of returns,
/// people and all. One scan looks alike in many places; such a stretch hardly in two.
class RecentScans {
 public:
  static constexpr std::size_t kScans = 8;       // remembered
  static constexpr double kStep = 0.2;           // [m] or [rad] of motion between two of them
  static constexpr std::size_t kMostBeams = 20;  // of one scan

  /// Takes a scan, unless the last one was taken nearly here. Returns whether it did.
  bool add(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan);
  void clear() { looks_.clear(); }

  /// Whether kScans scans are remembered.
  [[nodiscard]] bool full() const { return looks_.size() == kScans; }
  /// All their returns, in base as the odometry has it now.
  [[nodiscard]] ScanBeams seenFrom(const sarn::Pose2D& robot_in_odom) const;

 private:
  struct Look {
    sarn::Pose2D robot_in_odom;
    ScanBeams scan;
  };
  std::deque<Look> looks_;  // the oldest first
};

}  // namespace sarn_localization
