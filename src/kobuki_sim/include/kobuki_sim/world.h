// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kobuki_sim/contact.h"
#include "kobuki_sim/kobuki_base.h"
#include "kobuki_sim/people/crowd.h"
#include "kobuki_sim/robot_disc.h"
#include "kobuki_sim/scenario.h"
#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// A scenario come alive: map, robot and people, moved in fixed steps. Everything random comes from the seed:
/// same scenario, same seed, same commands at the same steps give bit-identical states.
class World {
 public:
  static constexpr double kDefaultTimeStep = 0.01;  // [s]

  /// Loads the scenario's map. Throws ScenarioError, sarn::MapError, CrowdError, RecordingError, or
  /// std::invalid_argument on bad parameters.
  World(const Scenario& scenario, std::uint64_t seed, const KobukiParams& params = {},
        const CrowdParams& crowd_params = {}, double time_step = kDefaultTimeStep);
  /// The same on a map that is loaded already (and may be shared by many worlds); null: open space.
  World(const Scenario& scenario, std::shared_ptr<const StaticMap> map, std::uint64_t seed,
        const KobukiParams& params = {}, const CrowdParams& crowd_params = {},
        double time_step = kDefaultTimeStep);

  /// Advances by one time step.
  void step();
  /// Back to time zero with another (or the same) seed.
  void reset(std::uint64_t seed);

  [[nodiscard]] double time() const { return static_cast<double>(steps_) * time_step_; }  // [s]
  [[nodiscard]] double timeStep() const { return time_step_; }                            // [s]
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t seed() const { return seed_; }

  /// map -> base_footprint, the truth.
  [[nodiscard]] const sarn::Pose2D& robotPose() const { return robot_pose_; }
  /// True twist in base_footprint.
  [[nodiscard]] const sarn::Twist2D& robotTwist() const { return base_.twist(); }
  /// The robot's disc, with its real velocity of the last step [m/s] in map.
  [[nodiscard]] RobotDisc robotDisc() const;
  /// Puts the robot, standing, somewhere else (its odometry does not notice).
  void placeRobot(const sarn::Pose2D& pose);

  [[nodiscard]] KobukiBase& base() { return base_; }
  [[nodiscard]] const KobukiBase& base() const { return base_; }
  [[nodiscard]] const std::vector<PersonState>& people() const { return crowd_.people(); }
  /// The scenario with the jitter of this seed drawn.
  [[nodiscard]] const Scenario& scenario() const { return scenario_; }
  /// Never null; an empty map is open space.
  [[nodiscard]] const StaticMap& map() const { return *map_; }

  /// Contacts that began in the last step.
  [[nodiscard]] const std::vector<Contact>& newContacts() const { return new_contacts_; }
  /// How long the robot has stood still [s].
  [[nodiscard]] double standingTime() const { return contact_monitor_.standingTime(); }

  /// 64 bits over the whole state; equal runs have equal digests.
  [[nodiscard]] std::uint64_t digest() const;

 private:
  Scenario original_;
  std::shared_ptr<const StaticMap> map_;
  KobukiParams params_;
  CrowdParams crowd_params_;
  double time_step_;  // [s]
  std::uint64_t seed_;
  Scenario scenario_;
  KobukiBase base_;
  Crowd crowd_;
  ContactMonitor contact_monitor_;
  std::uint64_t steps_ = 0;
  sarn::Pose2D robot_pose_;
  Eigen::Vector2d robot_velocity_ = Eigen::Vector2d::Zero();  // [m/s] in map, real
  std::vector<Contact> new_contacts_;
};

}  // namespace kobuki_sim
