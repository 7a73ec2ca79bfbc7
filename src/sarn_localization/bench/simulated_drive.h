// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "kobuki_sim/depth_camera.h"
#include "kobuki_sim/world.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_perception/depth_to_scan.h"

namespace sarn_localization {

/// Waypoints [m] of a tour file (launch/tours). Throws std::runtime_error.
[[nodiscard]] std::vector<Eigen::Vector2d> loadTour(const std::filesystem::path& file);

/// One depth scan of a drive, with the odometry of the same instant and the truth.
struct DriveSample {
  double time = 0.0;           // [s]
  sarn::Pose2D robot_in_map;   // the truth
  sarn::Pose2D robot_in_odom;  // what the driver publishes, drift included
  PlanarScan scan;             // of the Xtion, in its frame
};

/// A robot that drives round and round a tour in kobuki_sim's world, without ROS: steered by the truth, so
/// that the drive does not depend on what is measured, and waiting for people in its way. Same arguments,
/// same drive.
class SimulatedDrive {
 public:
  /// Without people when `crowded` is false.
  SimulatedDrive(kobuki_sim::Scenario scenario, std::vector<Eigen::Vector2d> tour, std::uint64_t seed,
                 bool crowded);

  /// Drives on until the next depth image (30 Hz on average, at the driver's packets).
  [[nodiscard]] DriveSample next();
  /// Carries the robot, and it goes on from the nearest waypoint.
  void kidnap(const sarn::Pose2D& robot_in_map);

  /// Tours finished.
  [[nodiscard]] int laps() const { return laps_; }
  [[nodiscard]] double driven() const { return driven_; }  // [m]
  [[nodiscard]] const kobuki_sim::World& world() const { return world_; }
  /// Of the Xtion's scan on a TurtleBot2.
  [[nodiscard]] sarn::Pose2D baseFromSensor() const;

 private:
  void steer();
  [[nodiscard]] bool somebodyAhead() const;
  [[nodiscard]] PlanarScan look();

  kobuki_sim::World world_;
  std::vector<Eigen::Vector2d> tour_;
  kobuki_sim::DepthCamera camera_;
  sarn_perception::DepthToScan converter_;
  std::size_t target_ = 0;
  int laps_ = 0;
  double driven_ = 0.0;
  std::uint64_t frames_ = 0;
};

}  // namespace sarn_localization
