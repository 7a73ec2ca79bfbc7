// SPDX-License-Identifier: BSD-3-Clause
#include "simulated_drive.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sarn_localization {
namespace {

constexpr double kFrequency = 30.0;    // [Hz] of the camera
constexpr double kArrival = 0.25;      // [m] from a waypoint
constexpr double kSpeed = 0.5;         // [m/s]
constexpr double kTurnRate = 1.2;      // [rad/s]
constexpr double kSteering = 2.5;      // [1/s] turn rate per bearing of the waypoint
constexpr double kPersonAhead = 0.85;  // [m] from centre to centre: wait

/// The rows around the optical axis that become the scan, and no others.
kobuki_sim::DepthCameraParams bandOfXtion() {
  kobuki_sim::DepthCameraParams params;
  params.height = 16;
  params.cy = 7.5;
  return params;
}

sarn_perception::DepthToScanParams shippedScanParams() {
  sarn_perception::DepthToScanParams params;
  params.scan_height = 10;
  params.out_of_range_policy = "inf";
  return params;
}

sarn_perception::CameraCalibration calibration(const kobuki_sim::DepthCameraParams& p) {
  return sarn_perception::pinholeCalibration(p.width, p.height, {p.fx, p.fy, p.cx, p.cy});
}

kobuki_sim::Scenario peopled(kobuki_sim::Scenario scenario, bool crowded) {
  if (!crowded) scenario.people.clear();
  return scenario;
}

}  // namespace

std::vector<Eigen::Vector2d> loadTour(const std::filesystem::path& file) {
  std::vector<Eigen::Vector2d> tour;
  try {
    const YAML::Node yaml = YAML::LoadFile(file.string());
    for (const auto& point : yaml["waypoints"]) {
      tour.emplace_back(point[0].as<double>(), point[1].as<double>());
    }
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  if (tour.empty()) throw std::runtime_error(file.string() + ": key 'waypoints' must be a list of [x, y]");
  return tour;
}

SimulatedDrive::SimulatedDrive(kobuki_sim::Scenario scenario, std::vector<Eigen::Vector2d> tour,
                               std::uint64_t seed, bool crowded)
    : world_(peopled(std::move(scenario), crowded), seed),
      tour_(std::move(tour)),
      camera_(bandOfXtion(), seed),
      converter_(shippedScanParams()) {}

sarn::Pose2D SimulatedDrive::baseFromSensor() const {
  return {camera_.params().mount_x, camera_.params().mount_y, 0.0};
}

DriveSample SimulatedDrive::next() {
  for (;;) {
    const std::uint64_t packets = world_.base().packetCount();
    const Eigen::Vector2d before = world_.robotPose().position();
    if (world_.steps() % 10 == 0) steer();
    world_.step();
    driven_ += (world_.robotPose().position() - before).norm();
    const bool due = world_.time() * kFrequency >= static_cast<double>(frames_ + 1);
    if (due && world_.base().packetCount() != packets) break;
  }
  ++frames_;
  return {world_.time(), world_.robotPose(), world_.base().odometry().pose(), look()};
}

void SimulatedDrive::kidnap(const sarn::Pose2D& robot_in_map) {
  world_.placeRobot(robot_in_map);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tour_.size(); ++i) {
    const double distance = (tour_[i] - robot_in_map.position()).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    target_ = i;
  }
}

bool SimulatedDrive::somebodyAhead() const {
  const sarn::Pose2D base_from_map = sarn::inverse(world_.robotPose());
  return std::any_of(world_.people().begin(), world_.people().end(), [&](const auto& person) {
    const Eigen::Vector2d p = base_from_map * person.position;
    return person.present && p.norm() < kPersonAhead && p.x() > 0.0 && std::abs(p.y()) < 0.5;
  });
}

void SimulatedDrive::steer() {
  const sarn::Pose2D base_from_map = sarn::inverse(world_.robotPose());
  Eigen::Vector2d aim = base_from_map * tour_[target_];
  if (aim.norm() < kArrival) {
    target_ = (target_ + 1) % tour_.size();
    if (target_ == 0) ++laps_;
    aim = base_from_map * tour_[target_];
  }
  const double bearing = std::atan2(aim.y(), aim.x());
  const double omega = std::clamp(kSteering * bearing, -kTurnRate, kTurnRate);
  const double v = somebodyAhead() ? 0.0 : kSpeed * std::max(0.0, 1.0 - std::abs(bearing) / 0.6);
  world_.base().commandVelocity(v, omega);
}

PlanarScan SimulatedDrive::look() {
  const auto& image = camera_.render(world_.map(), world_.robotPose(), world_.people(), frames_);
  sarn_perception::DepthImageView view;
  view.data = reinterpret_cast<const std::uint8_t*>(image.millimetres.data());
  view.size = image.millimetres.size() * sizeof(std::uint16_t);
  view.width = image.width;
  view.height = image.height;
  view.step = static_cast<std::size_t>(image.width) * sizeof(std::uint16_t);
  view.encoding = "16UC1";
  const auto scan = converter_.convert(view, calibration(camera_.params()), world_.time());
  return {static_cast<double>(scan.angle_min),
          static_cast<double>(scan.angle_increment),
          static_cast<double>(scan.range_min),
          static_cast<double>(scan.range_max),
          scan.ranges,
          world_.time()};
}

}  // namespace sarn_localization
