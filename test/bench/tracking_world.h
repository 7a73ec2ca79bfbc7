// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kobuki_sim/depth_camera.h"
#include "kobuki_sim/lidar.h"
#include "kobuki_sim/random.h"
#include "kobuki_sim/world.h"
#include "sarn_perception/depth_to_scan.h"
#include "tracking_score.h"

namespace sarn_tests {

enum class Motion { kStanding, kDriving, kTurning };

/// One run: the office, a robot that moves in one way, people.
struct RunSpec {
  std::string map;  // YAML
  Motion motion = Motion::kStanding;
  int people = 0;
  std::uint64_t seed = 1;
  double duration = 60.0;  // [s]
};

/// `people` who walk between free places around the robot or, one in four, stand; and the robot in a free
/// place. All from the seed.
[[nodiscard]] kobuki_sim::Scenario trackingScenario(const RunSpec& spec, const kobuki_sim::StaticMap& map);

/// The command of one moment for a way of moving.
[[nodiscard]] sarn::Twist2D commandFor(Motion motion, const kobuki_sim::World& world);

/// Localisation that errs: by 5 cm and 1.5 deg (standard deviations), slowly changing.
class LocalizationError {
 public:
  explicit LocalizationError(std::uint64_t seed) : random_(seed, "localization") {}
  /// `dt` [s] later; to be multiplied from the right to map_from_base.
  const sarn::Pose2D& advance(double dt);

 private:
  kobuki_sim::RandomStream random_;
  sarn::Pose2D error_;
  bool started_ = false;
};

/// A scan of the simulated lidar as the tracker takes it.
[[nodiscard]] sarn_perception::PlanarScan planarScan(const kobuki_sim::LidarScan& scan);

[[nodiscard]] sarn_perception::CameraCalibration calibrationOf(const kobuki_sim::DepthCameraParams& params);
[[nodiscard]] sarn_perception::DepthImageView viewOf(const kobuki_sim::DepthImage& image);
/// x right, y down, z ahead of a level camera.
[[nodiscard]] Eigen::Isometry3d baseFromOptical(const kobuki_sim::DepthCameraParams& params);

/// What must be seen of the world from a sensor's pose in map: people within `range` [m] and half a field of
/// view [rad] to each side, of whose width at least 30 % is in sight.
[[nodiscard]] std::vector<TruePerson> truthOf(const kobuki_sim::World& world,
                                              const sarn::Pose2D& map_from_sensor, double range_min,
                                              double range, double half_view);

}  // namespace sarn_tests
