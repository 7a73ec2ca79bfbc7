// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "sarn_common/people.h"
#include "sarn_navigation/navigator_params.h"

namespace sarn_navigation {

/// Somebody whose way the standing robot blocks.
struct BlockedPerson {
  std::string name;
  Eigen::Vector2d position;  // [m] planning frame
  Eigen::Vector2d velocity;  // [m/s] current, or the last one before the person had to stop for the robot
};

/// Distance [m] from p to the half-line on which the person walks.
[[nodiscard]] double distanceToWay(const Eigen::Vector2d& p, const BlockedPerson& person);

/// Tells whether a standing robot is in somebody's way. People who walk are judged by the straight line they
/// walk on; people who came to a halt in front of the robot by the direction they came from, for a few
/// seconds.
class YieldMonitor {
 public:
  explicit YieldMonitor(const NavigatorParams& params) : params_(params) {}

  /// Remembers how each person moves. Call at each prediction.
  void observe(const sarn::PeoplePrediction& people);

  /// The nearest person whose path leads through the robot's position [m]; nothing when the way is free.
  [[nodiscard]] std::optional<BlockedPerson> blockedBy(const Eigen::Vector2d& robot) const;

  void clear() { tracks_.clear(); }

 private:
  struct Track {
    Eigen::Vector2d position;
    Eigen::Vector2d walking_velocity = Eigen::Vector2d::Zero();  // last one above walking speed
    double walking_stamp = -1e9;                                 // [s] when that was
    double stamp = 0.0;                                          // [s]
    bool walking = false;
  };
  [[nodiscard]] bool leadsThrough(const Track& track, const Eigen::Vector2d& robot) const;

  NavigatorParams params_;
  std::map<std::string, Track> tracks_;
  double stamp_ = 0.0;  // [s] of the last prediction
};

}  // namespace sarn_navigation
