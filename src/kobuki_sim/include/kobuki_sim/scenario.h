// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sarn_common/pose2d.h"

namespace kobuki_sim {

/// A scenario that cannot be used; what() is one line that names the file, the key and what would be right.
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class PersonModel { kOrca, kSocialForce, kScripted, kStanding, kReplay };
/// What a person does at the last waypoint.
enum class OnArrival { kLoop, kStop, kRespawn, kReverse };

/// One entry of `people` in a scenario file. Positions in map.
struct PersonSpec {
  std::string name;  // unique, not empty
  PersonModel model = PersonModel::kOrca;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  std::optional<double> heading;                       // [rad]; otherwise towards the first waypoint
  std::vector<Eigen::Vector2d> waypoints;              // [m] visited in order
  OnArrival on_arrival = OnArrival::kLoop;
  double start_time = 0.0;       // [s] stands until then
  double preferred_speed = 1.0;  // [m/s]
  double radius = 0.25;          // [m]
  bool reacts_to_robot = true;
  std::string group;  // empty: alone

  // Only for kReplay: one entry becomes one person per id in the file.
  std::filesystem::path file;                        // absolute or relative to the working directory
  double frame_rate = 25.0;                          // [frames/s]
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  // [m] added to the recorded positions
  int start_frame = 0;                               // shown at time 0
};

/// Widths of the uniform draws that make seeds differ.
struct ScenarioJitter {
  double position = 0.0;         // [m] +- on each axis of a person's start position
  double start_time = 0.0;       // [s] 0.. added to a person's start time
  double preferred_speed = 0.0;  // [m/s] +-
};

struct Scenario {
  std::string name;
  std::filesystem::path source;     // the file it came from, for messages
  std::filesystem::path map;        // map YAML; empty: open space
  double time_limit = 240.0;        // [s] for all goals together
  sarn::Pose2D robot_pose;          // in map
  std::vector<sarn::Pose2D> goals;  // in map, visited in order
  std::vector<PersonSpec> people;
  ScenarioJitter jitter;
  std::uint64_t seed = 1;  // default of the scenario
};

/// Reads a scenario file; paths inside are taken relative to it. Throws ScenarioError on an unknown key, a
/// missing or malformed value, a value out of range or a file that is named and does not exist.
[[nodiscard]] Scenario loadScenario(const std::filesystem::path& file);

/// The same from a string; `source` names it in messages, its directory is the base of relative paths.
[[nodiscard]] Scenario parseScenario(const std::string& yaml,
                                     const std::filesystem::path& source = "scenario");

/// The scenario of one seed: its jitter drawn and added to the people. The jitter of a person depends on the
/// seed and on the person's place in the list only. Replayed and standing people keep their positions.
[[nodiscard]] Scenario jittered(const Scenario& scenario, std::uint64_t seed);

}  // namespace kobuki_sim
