// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "sarn_common/map_io.h"
#include "sarn_common/pose2d.h"
#include "sarn_perception/background.h"
#include "sarn_perception/body_detector.h"
#include "sarn_perception/leg_detector.h"
#include "sarn_perception/people_tracker.h"
#include "sarn_perception/tracking_params.h"

namespace sarn_perception {

struct PerceptionParams {
  BackgroundParams background;
  LegParams legs;
  BodyParams bodies;
  TrackerParams tracker;
};

/// Where the robot and the sensor were when something was measured.
struct SensorPose {
  sarn::Pose2D odom_from_sensor;
  sarn::Pose2D map_from_odom;
};

/// Map, detectors and tracker together: scans and depth images in, people in odom out.
class PeoplePerception {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit PeoplePerception(const PerceptionParams& params);

  void setMap(const sarn::OccupancyMap& map) { background_.setMap(map); }
  [[nodiscard]] bool hasMap() const { return background_.hasMap(); }

  /// A scan of `stamp` [s] and what it shows. False when it came too late or twice. Throws ScanError.
  bool takeScan(const PlanarScan& scan, const SensorPose& pose, double stamp);
  /// A depth image; `pose` is that of the base. Throws DepthInputError.
  bool takeDepth(const DepthImageView& image, const CameraCalibration& calibration,
                 const Eigen::Isometry3d& base_from_optical, const SensorPose& pose, double stamp);
  /// Time passes without a measurement.
  void advance(double stamp) { tracker_.advance(stamp); }
  void clear() { tracker_.clear(); }

  [[nodiscard]] const PeopleTracker& tracker() const { return tracker_; }

 private:
  void knowWhereWallsAre(const sarn::Pose2D& map_from_odom);

  Background background_;
  LegDetector leg_detector_;
  BodyDetector body_detector_;
  PeopleTracker tracker_;
};

}  // namespace sarn_perception
