// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_world.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"
#include "sarn_perception/visibility.h"

namespace sarn_tests {
namespace {

constexpr double kClearance = 0.45;  // [m] of places where somebody may start or go
constexpr double kAround = 6.0;      // [m] from the robot's start
constexpr double kHalfWidth = 0.18;  // [m] of the body that sight is asked for

Eigen::Vector2d freePlace(const kobuki_sim::StaticMap& map, const Eigen::Vector2d& around, double reach,
                          kobuki_sim::RandomStream& random) {
  for (;;) {
    const Eigen::Vector2d place(around.x() + random.uniform(-reach, reach),
                                around.y() + random.uniform(-reach, reach));
    const auto cell = map.geometry().cellAt(place.x(), place.y());
    if (cell && map.map().at(*cell) == sarn::kMapFree && map.discFree(place, kClearance)) return place;
  }
}

}  // namespace

kobuki_sim::Scenario trackingScenario(const RunSpec& spec, const kobuki_sim::StaticMap& map) {
  kobuki_sim::RandomStream random(spec.seed, "tracking scenario");
  kobuki_sim::Scenario scenario;
  scenario.name = "tracking";
  scenario.map = spec.map;
  const auto& grid = map.geometry();
  const Eigen::Vector2d middle(grid.origin_x + 0.5 * grid.width * grid.resolution,
                               grid.origin_y + 0.5 * grid.height * grid.resolution);
  const Eigen::Vector2d robot = freePlace(map, middle, 8.0, random);
  scenario.robot_pose = {robot.x(), robot.y(), random.uniform(-sarn::kPi, sarn::kPi)};
  while (static_cast<int>(scenario.people.size()) < spec.people) {
    kobuki_sim::PersonSpec person;
    person.name = "person " + std::to_string(scenario.people.size());
    person.position = freePlace(map, robot, kAround, random);
    const bool apart = (person.position - robot).norm() > 0.8 &&
                       std::all_of(scenario.people.begin(), scenario.people.end(), [&](const auto& other) {
                         return (other.position - person.position).norm() > 0.7;
                       });
    if (!apart) continue;
    person.heading = random.uniform(-sarn::kPi, sarn::kPi);
    if (scenario.people.size() % 4 == 3) {
      person.model = kobuki_sim::PersonModel::kStanding;
    } else {
      person.preferred_speed = random.uniform(0.5, 1.2);
      for (int i = 0; i < 4; ++i) person.waypoints.push_back(freePlace(map, robot, kAround, random));
    }
    scenario.people.push_back(person);
  }
  return scenario;
}

sarn::Twist2D commandFor(Motion motion, const kobuki_sim::World& world) {
  const double t = world.time();
  switch (motion) {
    case Motion::kStanding:
      return {};
    case Motion::kTurning:
      // One way round for 10 s, then the other.
      return {0.0, std::fmod(t, 20.0) < 10.0 ? 1.0 : -1.0};
    case Motion::kDriving:
      break;
  }
  // Ahead where it is free, turning away from what is near, with a slow weave.
  const sarn::Pose2D& pose = world.robotPose();
  const auto room = [&](double bearing) {
    const Eigen::Vector2d direction(std::cos(pose.theta + bearing), std::sin(pose.theta + bearing));
    const auto hit = world.map().rayCast(pose.position(), direction, 3.0);
    return hit ? hit->distance : 3.0;
  };
  const double ahead = std::min({room(0.0), room(0.3), room(-0.3)});
  if (ahead < 0.7) return {0.0, room(0.8) > room(-0.8) ? 1.0 : -1.0};
  return {std::min(0.5, 0.5 * ahead), 0.4 * std::sin(0.7 * t) + 0.3 * (room(0.8) - room(-0.8))};
}

const sarn::Pose2D& LocalizationError::advance(double dt) {
  // Ornstein and Uhlenbeck's process, 2 s long.
  constexpr double kSigma = 0.05;                          // [m]
  constexpr double kSigmaTheta = 1.5 * sarn::kPi / 180.0;  // [rad]
  const double keep = started_ ? std::exp(-dt / 2.0) : 0.0;
  const double fresh = std::sqrt(1.0 - keep * keep);
  started_ = true;
  error_.x = keep * error_.x + fresh * kSigma * random_.normal();
  error_.y = keep * error_.y + fresh * kSigma * random_.normal();
  error_.theta = keep * error_.theta + fresh * kSigmaTheta * random_.normal();
  return error_;
}

sarn_perception::PlanarScan planarScan(const kobuki_sim::LidarScan& scan) {
  sarn_perception::PlanarScan planar;
  planar.angle_min = static_cast<float>(scan.angle_min);
  planar.angle_increment = static_cast<float>(scan.angle_increment);
  planar.angle_max = static_cast<float>(scan.angle_min + scan.angle_increment *
                                                             (static_cast<double>(scan.ranges.size()) - 1.0));
  planar.range_min = static_cast<float>(scan.range_min);
  planar.range_max = static_cast<float>(scan.range_max);
  planar.ranges = scan.ranges;
  return planar;
}

sarn_perception::CameraCalibration calibrationOf(const kobuki_sim::DepthCameraParams& params) {
  return sarn_perception::pinholeCalibration(params.width, params.height,
                                             {params.fx, params.fy, params.cx, params.cy});
}

sarn_perception::DepthImageView viewOf(const kobuki_sim::DepthImage& image) {
  sarn_perception::DepthImageView view;
  view.data = reinterpret_cast<const std::uint8_t*>(image.millimetres.data());
  view.size = image.millimetres.size() * sizeof(image.millimetres[0]);
  view.width = image.width;
  view.height = image.height;
  view.step = static_cast<std::size_t>(image.width) * sizeof(image.millimetres[0]);
  view.encoding = "16UC1";
  return view;
}

Eigen::Isometry3d baseFromOptical(const kobuki_sim::DepthCameraParams& params) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(params.mount_x, params.mount_y, params.mount_z);
  pose.linear().col(0) = -Eigen::Vector3d::UnitY();
  pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
  pose.linear().col(2) = Eigen::Vector3d::UnitX();
  return pose;
}

std::vector<TruePerson> truthOf(const kobuki_sim::World& world, const sarn::Pose2D& map_from_sensor,
                                double range_min, double range, double half_view) {
  std::vector<TruePerson> truth;
  for (const auto& person : world.people()) {
    if (!person.present) continue;
    TruePerson one{person.id, person.position, person.velocity, false};
    const Eigen::Vector2d seen = sarn::inverse(map_from_sensor) * person.position;
    const bool in_view = seen.norm() >= range_min && seen.norm() <= range &&
                         std::abs(std::atan2(seen.y(), seen.x())) <= half_view;
    if (in_view) {
      std::vector<sarn_perception::Disc> others;
      for (const auto& other : world.people()) {
        if (other.present && other.id != person.id) others.push_back({other.position, kHalfWidth});
      }
      const double share = sarn_perception::visibleShare(world.map().map(), map_from_sensor.position(),
                                                         {person.position, kHalfWidth}, others);
      one.visible = share >= 0.3;
    }
    truth.push_back(one);
  }
  return truth;
}

}  // namespace sarn_tests
