// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kobuki_sim/people/crowd_params.h"
#include "kobuki_sim/people/itinerary.h"
#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/people/router.h"
#include "kobuki_sim/random.h"

namespace kobuki_sim {

/// The intentions of one person who reacts to others: which leg of the itinerary, which point of the route,
/// and when patience ends. It does not move anybody.
class Walker {
 public:
  /// `stream` gives the person's own draws.
  Walker(Itinerary itinerary, const Eigen::Vector2d& start, RandomStream stream);

  /// Velocity [m/s] that the person would take if alone, at `time` [s]; goes on to the next leg on arrival.
  /// `period` is the time [s] until the next call.
  [[nodiscard]] Eigen::Vector2d preferredVelocity(const PersonState& self, double time, double period,
                                                  const CrowdParams& params, const Router* router);

  /// Tells what came of it: `chosen` [m/s] is the velocity that avoidance left. True when the person has been
  /// blocked for so long that patience ends: then stepAside() or tryOn() has to follow.
  [[nodiscard]] bool losesPatience(const PersonState& self, const Eigen::Vector2d& chosen, double time,
                                   double period, const CrowdParams& params);
  /// Leaves the way for a while (drawn from yield_time), towards the unit vector `direction` or, where that
  /// is zero, in a drawn direction backwards and aside.
  void stepAside(const Eigen::Vector2d& direction, double time, const CrowdParams& params);
  /// Takes another way, around `obstacles`, and keeps to it for a while.
  void takeDetour(const PersonState& self, const std::vector<Disc>& obstacles, double time,
                  const Router& router);
  /// Keeps trying for another while.
  void tryOn(const CrowdParams& params);
  /// A number in [0, 1) of the person's own draws.
  [[nodiscard]] double draw() { return random_.uniform(); }

  /// True once the last waypoint of a person who is put back (OnArrival::kRespawn) is reached.
  [[nodiscard]] bool wantsToReturn() const { return wants_to_return_; }
  /// Starts the itinerary again.
  void restart();

  [[nodiscard]] bool isYielding(double time) const { return time < yield_until_; }
  [[nodiscard]] double blockedTime() const { return blocked_time_; }  // [s]
  /// Unit direction of the way ahead, or zero on arrival.
  [[nodiscard]] const Eigen::Vector2d& direction() const { return direction_; }

 private:
  void enterLeg(int leg);
  [[nodiscard]] bool isLastPoint() const { return route_point_ + 1 >= route_.size(); }
  [[nodiscard]] double arrivalTolerance(const CrowdParams& params) const;
  void passReachedPoints(const Eigen::Vector2d& position, const CrowdParams& params);
  void refreshRoute(const PersonState& self, double time, const Router* router);
  [[nodiscard]] Eigen::Vector2d lean(const Eigen::Vector2d& direction, double time,
                                     const CrowdParams& params);

  Itinerary itinerary_;
  Eigen::Vector2d start_;
  RandomStream random_;

  int leg_ = -1;                        // of the itinerary; -1: stays
  std::vector<Eigen::Vector2d> route_;  // points of the present leg, perhaps re-routed
  std::size_t route_point_ = 0;         // walking to this one
  bool wants_to_return_ = false;
  double next_look_;           // [s]
  double detour_until_ = 0.0;  // [s]

  Eigen::Vector2d direction_ = Eigen::Vector2d::Zero();
  double lean_angle_ = 0.0;    // [rad]
  double next_lean_ = 0.0;     // [s]
  double blocked_time_ = 0.0;  // [s]
  double patience_ = 0.0;      // [s] drawn anew after each stand-off; 0: draw one
  double yield_until_ = 0.0;   // [s]
  Eigen::Vector2d yield_direction_ = Eigen::Vector2d::Zero();
};

}  // namespace kobuki_sim
