// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/robot_disc.h"
#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// First touch between the robot and a person or a wall, in map.
struct Contact {
  double time = 0.0;                                // [s]
  std::string other;                                // the person's name, or "wall"
  int person = -1;                                  // PersonState::id; -1: wall
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // [m] where they touch
  double robot_closing_speed = 0.0;  // [m/s] robot's velocity towards the other; negative: away
  double other_closing_speed = 0.0;  // [m/s] the other's velocity towards the robot
  double robot_speed = 0.0;          // [m/s] of the robot's centre
  double standing_time = 0.0;        // [s] how long the robot had stood still before
};

/// Turns touching, step by step, into events: one when a touch begins; it ends after a time apart.
class ContactMonitor {
 public:
  struct Params {
    double tolerance = 1e-3;       // [m] a gap this small is a touch
    double release_time = 0.5;     // [s] apart before the same pair can touch anew
    double standing_speed = 0.01;  // [m/s] of its centre, and below: the robot stands
  };

  ContactMonitor() : ContactMonitor(Params{}) {}
  explicit ContactMonitor(const Params& params) : params_(params) {}

  /// `time` [s] at the end of a step of `dt` [s]; `robot` where the step left it, with the velocity it would
  /// have had without touching anything. Appends contacts that begin to `events`.
  void update(double time, double dt, const RobotDisc& robot, const std::vector<PersonState>& people,
              const StaticMap& map, std::vector<Contact>& events);
  void reset();

  /// How long the robot has stood still [s].
  [[nodiscard]] double standingTime() const { return standing_time_; }

 private:
  [[nodiscard]] bool beginsTouch(double& last_touch, double time) const;
  void updateWall(double time, const RobotDisc& robot, const StaticMap& map, std::vector<Contact>& events);
  void updatePerson(double time, const RobotDisc& robot, const PersonState& person,
                    std::vector<Contact>& events);

  Params params_;
  double standing_time_ = 0.0;
  double last_wall_touch_ = -HUGE_VAL;     // [s]
  std::vector<double> last_person_touch_;  // [s] by PersonState::id
};

}  // namespace kobuki_sim
