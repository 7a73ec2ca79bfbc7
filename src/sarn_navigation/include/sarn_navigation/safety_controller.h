// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "sarn_common/pose2d.h"

namespace sarn_navigation {

struct SafetyControllerParams {
  double rate = 10.0;                             // [1/s] of commands while an event is active
  double time_to_extend_bump_cliff_events = 0.0;  // [s] a released bumper or cliff sensor goes on counting
  double backward_speed = 0.1;                    // [m/s] away from what was touched
  double turn_speed = 0.4;                        // [rad/s] away from a touch at the side

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("rate", p.rate, {1.0, 100.0});
    v("time_to_extend_bump_cliff_events", p.time_to_extend_bump_cliff_events, {0.0, 60.0});
    v("backward_speed", p.backward_speed, {0.0, 0.5});
    v("turn_speed", p.turn_speed, {0.0, 3.0});
  }
};

/// Bumper and cliff sensors, numbered as in kobuki_msgs events.
enum class Side { kLeft = 0, kCenter = 1, kRight = 2 };
enum class Wheel { kLeft = 0, kRight = 1 };

/// Turns bumper, cliff and wheel-drop events into the command that gets the robot out: a dropped wheel stops
/// it; a touch in front, or on both sides, backs it up; a touch on one side backs it up and turns it away (as
/// kobuki_safety_controller).
class SafetyController {
 public:
  explicit SafetyController(const SafetyControllerParams& params);

  void setBumper(Side side, bool pressed, double now);
  void setCliff(Side side, bool over_edge, double now);
  void setWheelDrop(Wheel wheel, bool dropped);
  /// Forgets every event.
  void reset();

  /// The command at `now` [s]; nothing while no event is active.
  [[nodiscard]] std::optional<sarn::Twist2D> command(double now) const;

 private:
  struct Contact {
    bool active = false;
    double held_until = 0.0;   // [s], after the release
    double released_at = 0.0;  // [s]
  };
  using Contacts = std::array<Contact, 3>;  // by Side
  void set(Contact& contact, bool active, double now) const;
  [[nodiscard]] static bool holds(const Contact& contact, double now);
  [[nodiscard]] bool touched(Side side, double now) const;

  SafetyControllerParams params_;
  Contacts bumpers_;
  Contacts cliffs_;
  std::array<bool, 2> dropped_{};  // by Wheel
};

}  // namespace sarn_navigation
