// SPDX-License-Identifier: BSD-3-Clause
// Prints JSON lines: how far the walls of a map that was built on a drive lie from the true ones, and how far
// off the robot is when the loop closes. Usage: slam_bench LAUNCH_DIRECTORY [SEED [OUTPUT_MAP [PARAMS.yaml]]]
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_localization/grid_slam.h"
#include "sarn_localization/wall_distance.h"
#include "simulated_drive.h"

namespace {

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? -1.0
                        : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Distances [m] of points, turned about their middle and moved by `shift`, to the surfaces of walls.
std::vector<double> wallErrors(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& middle,
                               const sarn::Pose2D& shift, const sarn_localization::WallDistance& walls) {
  std::vector<double> errors;
  errors.reserve(points.size());
  for (const Eigen::Vector2d& point : points)
    errors.push_back(walls.at(middle + shift * (point - middle), 1.0));
  return errors;
}

/// The same errors after the map was laid onto the true one as well as it goes, as a rigid whole: how true it
/// is in itself, whatever way the robot's first look took it to lie.
std::vector<double> alignedErrors(const std::vector<Eigen::Vector2d>& points,
                                  const sarn_localization::WallDistance& walls) {
  constexpr double kFar = 0.3;      // [m] errors beyond count alike
  constexpr double kLever = 0.1;    // [rad/m] of steps
  constexpr double kFinest = 0.01;  // [m]
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) middle += point / static_cast<double>(points.size());
  const auto cost = [&](const sarn::Pose2D& shift) {
    double sum = 0.0;
    for (const double error : wallErrors(points, middle, shift, walls)) sum += std::min(error, kFar);
    return sum;
  };
  sarn::Pose2D best;
  double least = cost(best);
  for (double step = 0.08; step >= kFinest;) {
    const sarn::Pose2D before = best;
    for (const sarn::Pose2D& way : {sarn::Pose2D{step, 0.0, 0.0}, sarn::Pose2D{0.0, step, 0.0},
                                    sarn::Pose2D{0.0, 0.0, kLever * step}}) {
      for (const double sign : {-1.0, 1.0}) {
        const sarn::Pose2D next{best.x + sign * way.x, best.y + sign * way.y, best.theta + sign * way.theta};
        const double value = cost(next);
        if (value >= least) continue;
        least = value;
        best = next;
      }
    }
    if (before.x == best.x && before.y == best.y && before.theta == best.theta) step *= 0.5;
  }
  return wallErrors(points, middle, best, walls);
}

int run(const std::filesystem::path& launch, std::uint64_t seed, const char* output,
        sarn_localization::SlamParams params) {
  constexpr double kTimeLimit = 900.0;  // [s]
  const auto scenario = kobuki_sim::loadScenario(launch / "scenarios/office.yaml");
  sarn_localization::SimulatedDrive drive(scenario, sarn_localization::loadTour(launch / "tours/office.yaml"),
                                          seed, true);
  params.random_seed = static_cast<int>(seed);
  sarn_localization::GridSlam slam(params);
  auto sample = drive.next();
  const sarn::Pose2D world_from_map = sample.robot_in_map;  // the map begins at the first scan
  double greatest_error = 0.0;
  double error = 0.0;
  int used = 0;
  for (; drive.laps() < 1 && sample.time < kTimeLimit; sample = drive.next()) {
    if (!slam.addScan(sample.robot_in_odom, drive.baseFromSensor(), sample.scan)) continue;
    ++used;
    const sarn::Pose2D found = world_from_map * *slam.mapFromOdom() * sample.robot_in_odom;
    error = (found.position() - sample.robot_in_map.position()).norm();
    greatest_error = std::max(greatest_error, error);
    if (std::getenv("BENCH_TRACE") != nullptr && used % 20 == 0) {
      const sarn::Pose2D off = sarn::inverse(sample.robot_in_map) * found;
      const sarn::Pose2D blind = sarn::inverse(sample.robot_in_map) * world_from_map * sample.robot_in_odom;
      std::fprintf(stderr,
                   "%.1f s at (%.1f, %.1f): off %.3f %.3f m %.2f deg, odometry %.3f %.3f m %.2f deg\n",
                   sample.time, sample.robot_in_map.x, sample.robot_in_map.y, off.x, off.y,
                   off.theta * 180.0 / sarn::kPi, blind.x, blind.y, blind.theta * 180.0 / sarn::kPi);
    }
  }
  const auto map = slam.map();
  if (!map) throw std::runtime_error("no map was built");
  const sarn_localization::WallDistance truth(drive.world().map().map());
  std::vector<Eigen::Vector2d> occupied;  // [m] in the world
  for (int y = 0; y < map->geometry.height; ++y) {
    for (int x = 0; x < map->geometry.width; ++x) {
      if (map->at({x, y}) != sarn::kMapOccupied) continue;
      occupied.push_back(world_from_map * map->geometry.center({x, y}));
    }
  }
  std::fprintf(stderr,
               "seed %d: %.0f s, %.0f m, %d scans used, pose error %.3f m at the end, %.3f m at most\n",
               static_cast<int>(seed), sample.time, drive.driven(), used, error, greatest_error);
  const std::vector<double> errors = wallErrors(occupied, Eigen::Vector2d::Zero(), {}, truth);
  std::printf("{\"slam.wall_error_m.p95\": %.4f}\n", percentile(errors, 0.95));
  std::printf("{\"slam.wall_error_aligned_m.p95\": %.4f}\n",
              percentile(alignedErrors(occupied, truth), 0.95));
  std::printf("{\"slam.wall_error_m.median\": %.4f}\n", percentile(errors, 0.5));
  std::printf("{\"slam.loop_error_m\": %.4f}\n", error);
  if (output != nullptr) sarn::saveMap(*map, output);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: slam_bench LAUNCH_DIRECTORY [SEED [OUTPUT_MAP [PARAMS.yaml]]]\n");
    return EXIT_FAILURE;
  }
  try {
    sarn_localization::SlamParams params;
    if (argc > 4) {
      for (const auto& problem : sarn::setFromYaml(YAML::LoadFile(argv[4]), params)) {
        throw std::runtime_error(std::string(argv[4]) + ": " + problem);
      }
    }
    return run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1, argc > 3 ? argv[3] : nullptr,
               params);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
