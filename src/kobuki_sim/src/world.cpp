// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/world.h"

#include <cstring>
#include <string>
#include <utility>

#include "kobuki_sim/robot_motion.h"

namespace kobuki_sim {
namespace {

constexpr double kBumperTolerance = 1e-3;  // [m] a gap this small presses a bumper

std::shared_ptr<const StaticMap> loadMapOf(const Scenario& scenario) {
  if (scenario.map.empty()) return nullptr;
  return std::make_shared<const StaticMap>(StaticMap::load(scenario.map));
}

[[noreturn]] void failInWall(const Scenario& scenario, const std::string& key, const Eigen::Vector2d& p,
                             double radius) {
  throw ScenarioError(scenario.source.string() + ": " + key + ": (" + std::to_string(p.x()) + ", " +
                      std::to_string(p.y()) + ") with radius " + std::to_string(radius) +
                      " m is in a wall; give a free place");
}

bool startsSomewhere(const PersonSpec& person) { return person.model != PersonModel::kReplay; }

/// The robot and everyone with a start position must stand free.
void requireFreeStarts(const Scenario& scenario, const StaticMap& map, double robot_radius) {
  if (!map.discFree(scenario.robot_pose.position(), robot_radius)) {
    failInWall(scenario, "robot.pose", scenario.robot_pose.position(), robot_radius);
  }
  for (std::size_t i = 0; i < scenario.people.size(); ++i) {
    const PersonSpec& person = scenario.people[i];
    if (startsSomewhere(person) && !map.discFree(person.position, person.radius)) {
      failInWall(scenario, "people[" + std::to_string(i) + "].position", person.position, person.radius);
    }
  }
}

/// Checks the starts and draws the jitter; a start that it moved into or behind a wall is brought out again,
/// or stays as it was.
Scenario drawn(const Scenario& original, const StaticMap& map, double robot_radius, std::uint64_t seed) {
  requireFreeStarts(original, map, robot_radius);
  Scenario scenario = jittered(original, seed);
  for (std::size_t i = 0; i < scenario.people.size(); ++i) {
    PersonSpec& person = scenario.people[i];
    if (!startsSomewhere(person)) continue;
    const Eigen::Vector2d& start = original.people[i].position;
    person.position = map.pushOut(person.position, person.radius);
    if (!map.discFree(person.position, person.radius) || !map.segmentFree(start, person.position)) {
      person.position = start;
    }
  }
  return scenario;
}

/// FNV-1a over 64-bit words.
class Digest {
 public:
  void operator()(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash_ = (hash_ ^ bits) * 0x100000001b3ULL;
    hash_ ^= hash_ >> 32;  // the multiplication alone never moves high bits down
  }
  void operator()(const Eigen::Vector2d& v) {
    (*this)(v.x());
    (*this)(v.y());
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace

World::World(const Scenario& scenario, std::uint64_t seed, const KobukiParams& params,
             const CrowdParams& crowd_params, double time_step)
    : World(scenario, loadMapOf(scenario), seed, params, crowd_params, time_step) {}

World::World(const Scenario& scenario, std::shared_ptr<const StaticMap> map, std::uint64_t seed,
             const KobukiParams& params, const CrowdParams& crowd_params, double time_step)
    : original_(scenario),
      map_(map ? std::move(map) : std::make_shared<const StaticMap>()),
      params_(params),
      crowd_params_(crowd_params),
      time_step_(time_step),
      seed_(seed),
      scenario_(drawn(scenario, *map_, params.hull_radius, seed)),
      base_(params, time_step, seed),
      crowd_(scenario_, map_.get(), seed, crowd_params),
      robot_pose_(scenario.robot_pose) {}

void World::reset(std::uint64_t seed) {
  *this = World(original_, map_, seed, params_, crowd_params_, time_step_);
}

RobotDisc World::robotDisc() const { return {robot_pose_.position(), robot_velocity_, params_.hull_radius}; }

void World::placeRobot(const sarn::Pose2D& pose) {
  robot_pose_ = pose;
  robot_velocity_.setZero();
}

void World::step() {
  crowd_.step(time_step_, robotDisc());
  const sarn::Twist2D wanted = base_.drive();
  const sarn::Pose2D before = robot_pose_;
  const RobotStep moved = moveRobot(before, wanted, time_step_, params_.hull_radius, *map_, people());
  robot_pose_ = moved.pose;
  robot_velocity_ = moved.velocity;
  base_.settle(moved.twist, moved.blocked,
               pressedBumpers(robot_pose_, params_.hull_radius, kBumperTolerance, *map_, people()));
  ++steps_;

  const Eigen::Vector2d free_velocity =
      (sarn::advance(before, wanted, time_step_).position() - before.position()) / time_step_;
  new_contacts_.clear();
  contact_monitor_.update(time(), time_step_, {robot_pose_.position(), free_velocity, params_.hull_radius},
                          people(), *map_, new_contacts_);
}

std::uint64_t World::digest() const {
  Digest digest;
  digest(static_cast<double>(steps_));
  digest(robot_pose_.position());
  digest(robot_pose_.theta);
  digest(robot_velocity_);
  base_.digest(digest);
  for (const PersonState& person : people()) {
    digest(person.position);
    digest(person.velocity);
    digest(person.heading);
    digest(person.walking_phase);
    digest(person.present ? 1.0 : 0.0);
  }
  return digest.value();
}

}  // namespace kobuki_sim
