// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "sarn_common/pose2d.h"

namespace sarn_localization {

/// The robot's pose in two frames at the same instant.
struct PosePair {
  std::int64_t stamp = 0;      // [ns]
  sarn::Pose2D robot_in_map;   // [m, rad]
  sarn::Pose2D robot_in_odom;  // [m, rad]
};

/// Drift of the odometry: map_from_odom * odom_from_robot = map_from_robot.
[[nodiscard]] sarn::Pose2D mapFromOdom(const PosePair& pair);

/// Pairs two streams of poses by equal stamps. Within a stream stamps grow; one that does not (the clock
/// jumped back, a new episode) forgets everything before it. Each stream keeps at most `capacity` poses
/// without a partner.
class PosePairMatcher {
 public:
  explicit PosePairMatcher(std::size_t capacity = 100);

  /// The pair that this pose completes, if its partner has arrived. Stamp in [ns].
  [[nodiscard]] std::optional<PosePair> addTruth(std::int64_t stamp, const sarn::Pose2D& robot_in_map);
  [[nodiscard]] std::optional<PosePair> addOdometry(std::int64_t stamp, const sarn::Pose2D& robot_in_odom);

 private:
  struct Stream {
    std::map<std::int64_t, sarn::Pose2D> waiting;
    std::optional<std::int64_t> newest;
  };
  /// Partner of the pose in `other`, else the pose is kept in `own`.
  [[nodiscard]] std::optional<sarn::Pose2D> match(std::int64_t stamp, const sarn::Pose2D& pose, Stream& own,
                                                  Stream& other);

  std::size_t capacity_;
  Stream truth_;
  Stream odometry_;
};

}  // namespace sarn_localization
