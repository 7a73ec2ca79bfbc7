// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "kobuki_sim/kobuki_base.h"
#include "kobuki_sim/people/orca.h"
#include "kobuki_sim/people/social_force.h"

namespace kobuki_sim {

/// What an action of two numbers means and how the robot carries it out.
enum class RobotKinematics {
  kHolonomic,  // (vx, vy) [m/s] in map, at once
  kUnicycle,   // (speed [m/s], change of heading [rad]): turns at once, then drives straight on for the step
  kTurtlebot,  // (v [m/s], omega [rad/s]) held for the step by a KobukiBase with its limits and delay
};

enum class TrainingPeopleModel { kOrca, kSocialForce };

struct TrainingParams {
  double time_step = 0.25;  // [s] > 0, one action
  RobotKinematics robot_kinematics = RobotKinematics::kHolonomic;
  TrainingPeopleModel people_model = TrainingPeopleModel::kOrca;
  bool robot_visible = false;        // people avoid the robot as they avoid each other
  double people_safety_space = 0.0;  // [m] >= 0, added by people to every radius
  double robot_safety_space = 0.0;   // [m] >= 0, added to every radius by the robot's own ORCA
  double radius_margin = 0.01;       // [m] >= 0, added to every radius by all ORCA agents besides
  double time_limit = 25.0;          // [s] > 0, the step that reaches it is a timeout
  OrcaParams orca{10.0, 10, 5.0, 5.0};
  SocialForceParams social_force;
  KobukiParams base;             // of kTurtlebot
  double base_time_step = 0.01;  // [s] > 0, of kTurtlebot
};

/// Somebody with a goal, in map.
struct TrainingAgent {
  MovingDisc disc;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();  // [m]
  double preferred_speed = 1.0;                    // [m/s]
};

struct TrainingOutcome {
  /// [m] between the robot's rim and the nearest rim at the closest approach of the motions within the step;
  /// infinite without people.
  double min_separation = 0.0;
  bool reached = false;    // the robot's centre is nearer to its goal than its radius
  bool collision = false;  // min_separation < 0
  bool timeout = false;    // the time limit is reached
};

/// The open world of crowd-navigation training (the benchmark of Chen et al. 2019, "Crowd-Robot
/// Interaction"): discs with goals, all deciding from one snapshot, everybody moving straight for one time
/// step. People walk towards their goals with their preferred speed, slower within a second of it, avoid each
/// other by ORCA or social force, and stay there.
class TrainingWorld {
 public:
  explicit TrainingWorld(const TrainingParams& params);

  /// Begins an episode. `theta` [rad] is the robot's heading.
  void reset(const TrainingAgent& robot, double theta, const std::vector<TrainingAgent>& people,
             std::uint64_t seed);

  /// One action of the robot and one step of everybody. The action must be finite.
  TrainingOutcome step(const Eigen::Vector2d& action);

  /// The velocities [m/s] that people will have in the next step; they do not depend on the robot's next
  /// action.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& nextPeopleVelocities();
  /// The velocity [m/s] that ORCA gives the robot here, with robot_safety_space.
  [[nodiscard]] Eigen::Vector2d robotOrcaVelocity();

  [[nodiscard]] const TrainingAgent& robot() const { return robot_; }
  [[nodiscard]] double theta() const { return theta_; }  // [rad]
  [[nodiscard]] double omega() const { return omega_; }  // [rad/s] of the last step
  [[nodiscard]] const std::vector<TrainingAgent>& people() const { return people_; }
  [[nodiscard]] double time() const { return time_; }  // [s] since the reset

 private:
  void decideByOrca();
  void decideBySocialForce();
  [[nodiscard]] Eigen::Vector2d orcaVelocityOf(const TrainingAgent& agent, std::size_t self, bool sees_robot,
                                               double extra_radius);
  [[nodiscard]] Eigen::Vector2d socialForceOn(std::size_t i) const;
  [[nodiscard]] double moveInstantly(const Eigen::Vector2d& action);
  [[nodiscard]] double moveBase(const Eigen::Vector2d& action);
  /// Least gap [m] over a part of the step: the robot goes straight from where it is to `robot_end` while
  /// people walk on from `part_begin` to `part_end` [s] of the step.
  [[nodiscard]] double closestApproach(const Eigen::Vector2d& robot_end, double part_begin,
                                       double part_end) const;

  TrainingParams params_;
  TrainingAgent robot_;
  double theta_ = 0.0;
  double omega_ = 0.0;
  double time_ = 0.0;
  std::vector<TrainingAgent> people_;
  std::vector<Eigen::Vector2d> next_velocities_;
  bool decided_ = false;
  std::optional<KobukiBase> base_;
  // Working memory.
  OrcaSolver solver_;
  std::vector<OrcaNeighbor> neighbors_;
  std::vector<double> squared_distances_;  // [m^2] of neighbors_
  std::vector<MovingDisc> rollout_;
  std::vector<Eigen::Vector2d> forces_;
};

/// Towards the goal with the preferred speed, slower when the goal is less than a second away [m/s].
[[nodiscard]] Eigen::Vector2d preferredVelocity(const TrainingAgent& agent);

/// Least distance [m] between two points whose difference goes straight from `begin` to `end`.
[[nodiscard]] double closestDistance(const Eigen::Vector2d& begin, const Eigen::Vector2d& end);

}  // namespace kobuki_sim
