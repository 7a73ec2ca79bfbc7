// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kobuki_sim/lidar_params.h"
#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/static_map.h"
#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// Ranges of one turn of a lidar, in its frame (x ahead, y left). Plus infinity: nothing within range_max;
/// minus infinity: something nearer than range_min (REP 117).
struct LidarScan {
  double angle_min = 0.0;        // [rad] of the first beam
  double angle_increment = 0.0;  // [rad]
  double range_min = 0.0;        // [m]
  double range_max = 0.0;        // [m]
  std::vector<float> ranges;     // [m]
};

/// Measures what a level 2D lidar sees: walls of the map, and people's bodies (body_shape.h) cut at its
/// height. All beams are of one moment: the turn of the mirror is not simulated.
class Lidar {
 public:
  /// Throws std::invalid_argument that names every problem of the parameters.
  Lidar(const LidarParams& params, std::uint64_t seed);

  /// The scan from a pose of base_footprint in map. Same seed, frame number and scene: same scan, whatever
  /// was measured before. The scan stays valid until the next call.
  const LidarScan& measure(const StaticMap& map, const sarn::Pose2D& map_from_base,
                           const std::vector<PersonState>& people, std::uint64_t frame);

  [[nodiscard]] const LidarParams& params() const { return params_; }
  [[nodiscard]] sarn::Pose2D baseFromLidar() const {
    return {params_.mount_x, params_.mount_y, params_.mount_yaw};
  }

 private:
  void castWalls(const StaticMap& map, const sarn::Pose2D& map_from_lidar);
  void castPeople(const sarn::Pose2D& map_from_lidar, const std::vector<PersonState>& people);
  void corrupt(std::uint64_t frame);
  [[nodiscard]] double bearing(std::size_t beam) const {
    return scan_.angle_min + scan_.angle_increment * static_cast<double>(beam);
  }

  LidarParams params_;
  std::uint64_t seed_;
  LidarScan scan_;
  std::vector<double> range_;  // [m] true ranges, infinite: nothing
};

}  // namespace kobuki_sim
