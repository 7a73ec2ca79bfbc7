// SPDX-License-Identifier: BSD-3-Clause
// Prints JSON lines: errors of localisation on simulated drives among people, time until a carried robot is
// found again, CPU time. Usage: localization_bench LAUNCH_DIRECTORY [SEEDS [MINUTES [PARAMS.yaml
// [FIRST_SEED]]]]
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "sarn_common/parameters.h"
#include "sarn_localization/monte_carlo_localizer.h"
#include "simulated_drive.h"

namespace {

using sarn_localization::DriveSample;
using sarn_localization::MonteCarloLocalizer;
using sarn_localization::SimulatedDrive;

constexpr double kDegrees = 180.0 / sarn::kPi;
constexpr double kFoundDistance = 0.3;  // [m] of the truth, and
constexpr double kFoundAngle = 0.2;     // [rad]: found

struct Errors {
  std::vector<double> metres, degrees;
  double drift = 0.0;  // [m] the greatest error that the odometry alone had
};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return -1.0;
  const auto k = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

class Bench {
 public:
  Bench(const std::filesystem::path& launch, sarn_localization::LocalizationParams params)
      : params_(std::move(params)),
        scenario_(kobuki_sim::loadScenario(launch / "scenarios/office.yaml")),
        tour_(sarn_localization::loadTour(launch / "tours/office.yaml")) {}

  Errors drive(std::uint64_t seed, double duration) {
    SimulatedDrive drive(scenario_, tour_, seed, true);
    MonteCarloLocalizer localizer = start(drive, seed);
    Errors errors;
    for (DriveSample sample = drive.next(); sample.time < duration; sample = drive.next()) {
      const sarn::Pose2D found = step(localizer, drive, sample);
      trace(localizer, sample, found);
      errors.metres.push_back((found.position() - sample.robot_in_map.position()).norm());
      errors.degrees.push_back(kDegrees *
                               std::abs(sarn::angleDifference(sample.robot_in_map.theta, found.theta)));
      const Eigen::Vector2d dead_reckoned = (scenario_.robot_pose * sample.robot_in_odom).position();
      errors.drift = std::max(errors.drift, (dead_reckoned - sample.robot_in_map.position()).norm());
    }
    std::fprintf(stderr,
                 "seed %d: driven %.0f m, %d laps, error p95 %.3f m %.2f deg max %.3f m, odometry's %.2f m\n",
                 static_cast<int>(seed), drive.driven(), drive.laps(), percentile(errors.metres, 0.95),
                 percentile(errors.degrees, 0.95), percentile(errors.metres, 1.0), errors.drift);
    return errors;
  }

  /// Time [s] from being carried to another room until the robot knows where it is, and stays so for a while;
  /// negative: not within `patience` [s].
  double kidnapped(std::uint64_t seed, double patience) {
    SimulatedDrive drive(scenario_, tour_, seed, true);
    MonteCarloLocalizer localizer = start(drive, seed);
    constexpr std::uint64_t kTimes = 16;
    const double kidnapped_at = 20.0 + 7.0 * static_cast<double>((seed - 1) % kTimes + 1);
    DriveSample sample = drive.next();
    for (; sample.time < kidnapped_at; sample = drive.next()) step(localizer, drive, sample);
    const std::vector<sarn::Pose2D> places = {{15.0, 6.0, 3.0}, {14.2, 9.5, 1.5}, {9.0, 3.0, -1.5},
                                              {9.2, 9.5, 1.2},  {2.4, 3.0, 1.5},  {5.6, 10.0, -1.5}};
    sarn::Pose2D place = places[seed % places.size()];
    if ((place.position() - sample.robot_in_map.position()).norm() < 4.0) {
      place = places[(seed + 1) % places.size()];
    }
    drive.kidnap(place);
    constexpr double kStays = 5.0;  // [s]
    double found_since = -1.0;
    for (;;) {
      sample = drive.next();
      const double since = sample.time - kidnapped_at;
      if (since > patience + kStays) return -1.0;
      const sarn::Pose2D found = step(localizer, drive, sample);
      trace(localizer, sample, found);
      const bool right =
          (found.position() - sample.robot_in_map.position()).norm() < kFoundDistance &&
          std::abs(sarn::angleDifference(sample.robot_in_map.theta, found.theta)) < kFoundAngle;
      if (!right) found_since = -1.0;
      if (right && found_since < 0.0) found_since = since;
      if (found_since >= 0.0 && since - found_since >= kStays) return found_since;
      if (found_since < 0.0 && since > patience) return -1.0;
    }
  }

  [[nodiscard]] double cpuShare() const { return cpu_seconds_ / (static_cast<double>(frames_) / 30.0); }

 private:
  MonteCarloLocalizer start(const SimulatedDrive& drive, std::uint64_t seed) {
    params_.random_seed = static_cast<int>(seed);
    MonteCarloLocalizer localizer(params_);
    localizer.setMap(drive.world().map().map());
    sarn_localization::PoseEstimate pose{scenario_.robot_pose, Eigen::Matrix3d::Zero()};
    pose.covariance.diagonal() << 0.04, 0.04, 0.02;
    localizer.setPose(pose, drive.world().base().odometry().pose());
    return localizer;
  }

  /// The pose that the localizer gives for this sample.
  sarn::Pose2D step(MonteCarloLocalizer& localizer, const SimulatedDrive& drive, const DriveSample& sample) {
    const std::clock_t begin = std::clock();
    const auto beams =
        sarn_localization::selectBeams(sample.scan, drive.baseFromSensor(), beamLimits(params_));
    localizer.addScan(sample.robot_in_odom, beams);
    const sarn::Pose2D pose = localizer.mapFromOdom().value_or(sarn::Pose2D{}) * sample.robot_in_odom;
    cpu_seconds_ += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    ++frames_;
    return pose;
  }

  /// With BENCH_TRACE in the environment: a line a second, to stderr.
  void trace(const MonteCarloLocalizer& localizer, const DriveSample& sample,
             const sarn::Pose2D& found) const {
    if (std::getenv("BENCH_TRACE") == nullptr || frames_ % 30 != 0) return;
    const auto& truth = sample.robot_in_map;
    const auto& s = localizer.status();
    std::fprintf(
        stderr,
        "%.1f s at %.2f %.2f %.2f, found %.2f %.2f %.2f, off %.3f m %.2f deg, beams %zu skipped %zu, "
        "explained %.2f slow %.2f fast %.2f random %.2f, %zu particles\n",
        sample.time, truth.x, truth.y, truth.theta, found.x, found.y, found.theta,
        (found.position() - truth.position()).norm(),
        kDegrees * std::abs(sarn::angleDifference(truth.theta, found.theta)), s.beams, s.skipped_beams,
        s.explained, s.slow, s.fast, s.random_share, localizer.particles().size());
  }

  sarn_localization::LocalizationParams params_;
  kobuki_sim::Scenario scenario_;
  std::vector<Eigen::Vector2d> tour_;
  double cpu_seconds_ = 0.0;
  std::uint64_t frames_ = 0;
};

int run(const std::filesystem::path& launch, int seeds, double minutes,
        const sarn_localization::LocalizationParams& params, int first) {
  Bench bench(launch, params);
  Errors all;
  for (int seed = first; seed < first + seeds && minutes > 0.0; ++seed) {
    const Errors errors = bench.drive(static_cast<std::uint64_t>(seed), 60.0 * minutes);
    all.metres.insert(all.metres.end(), errors.metres.begin(), errors.metres.end());
    all.degrees.insert(all.degrees.end(), errors.degrees.begin(), errors.degrees.end());
    all.drift = std::max(all.drift, errors.drift);
  }
  if (minutes > 0.0) {
    std::printf("{\"localization.error_m.p95\": %.4f}\n", percentile(all.metres, 0.95));
    std::printf("{\"localization.error_m.max\": %.4f}\n", percentile(all.metres, 1.0));
    std::printf("{\"localization.error_deg.p95\": %.4f}\n", percentile(all.degrees, 0.95));
    std::printf("{\"localization.odometry_drift_m.max\": %.4f}\n", all.drift);
    std::printf("{\"localization.cpu_cores\": %.5f}\n", bench.cpuShare());
  }

  constexpr double kPatience = 60.0;  // [s]
  constexpr double kGoal = 20.0;      // [s]
  std::vector<double> times;
  int in_time = 0;
  const int kidnappings = 4 * seeds;
  for (int seed = first; seed < first + kidnappings; ++seed) {
    const double time = bench.kidnapped(static_cast<std::uint64_t>(seed), kPatience);
    std::fprintf(stderr, "kidnapped, seed %d: found after %.1f s\n", seed, time);
    times.push_back(time < 0.0 ? kPatience : time);
    if (time >= 0.0 && time <= kGoal) ++in_time;
  }
  std::printf("{\"localization.kidnapped_s.median\": %.2f}\n", percentile(times, 0.5));
  std::printf("{\"localization.kidnapped_within_20s\": %.3f}\n", static_cast<double>(in_time) / kidnappings);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: localization_bench LAUNCH_DIRECTORY [SEEDS [MINUTES [PARAMS.yaml [FIRST_SEED]]]]\n");
    return EXIT_FAILURE;
  }
  try {
    sarn_localization::LocalizationParams params;
    if (argc > 4 && argv[4][0] != '\0') {
      for (const auto& problem : sarn::setFromYaml(YAML::LoadFile(argv[4]), params)) {
        throw std::runtime_error(std::string(argv[4]) + ": " + problem);
      }
    }
    return run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 3, argc > 3 ? std::atof(argv[3]) : 10.0,
               params, argc > 5 ? std::max(1, std::atoi(argv[5])) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
