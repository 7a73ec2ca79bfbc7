// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "kobuki_sim/people/crowd_params.h"
#include "kobuki_sim/people/neighbor_grid.h"
#include "kobuki_sim/people/orca.h"
#include "kobuki_sim/people/person_model.h"
#include "kobuki_sim/people/recording.h"
#include "kobuki_sim/people/router.h"
#include "kobuki_sim/people/walker.h"
#include "kobuki_sim/people/wall_index.h"
#include "kobuki_sim/robot_disc.h"
#include "kobuki_sim/scenario.h"
#include "kobuki_sim/static_map.h"

namespace kobuki_sim {

/// People that cannot be placed or sent where the scenario says; what() is one line that names the person.
class CrowdError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All people of a scenario. Those who react (orca, social_force) decide together, from one snapshot, every
/// decision period and are moved every step; they never enter a wall. Scripted people keep an exact
/// timetable, standing people stand, replayed people move as recorded; none of these react. Same scenario,
/// map, seed and robot: same crowd, bit by bit. A copy is a crowd of its own.
class Crowd {
 public:
  /// `scenario` has its jitter drawn already; `map` may be null (open space), is not owned and outlives the
  /// crowd. Finds all ways between waypoints. Throws CrowdError when somebody stands in a wall or a waypoint
  /// cannot be reached, RecordingError for a recording that cannot be used.
  Crowd(const Scenario& scenario, const StaticMap* map, std::uint64_t seed, const CrowdParams& params = {});

  /// Advances everyone by dt [s] > 0. `robot` is the robot at the beginning of the step; it is taken to go on
  /// with its velocity when dt spans several decisions.
  void step(double dt, const RobotDisc& robot);

  [[nodiscard]] const std::vector<PersonState>& people() const { return people_; }
  [[nodiscard]] double time() const { return time_; }  // [s] since the start
  [[nodiscard]] const CrowdParams& params() const { return params_; }

 private:
  /// What moves a person, beside the visible state.
  struct Mover {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();    // [m]
    double start_heading = 0.0;                         // [rad]
    double start_time = 0.0;                            // [s]
    Eigen::Vector2d command = Eigen::Vector2d::Zero();  // [m/s] until the next decision
    int source = -1;                                    // of walkers_, itineraries_ or recorded_, by model
    int group = -1;                                     // of groups_
    std::size_t recording_hint = 0;
  };

  // Setting up.
  void prepareSpace(const Scenario& scenario);
  void addPerson(const PersonSpec& spec, std::uint64_t seed);
  void addReplayed(const PersonSpec& spec);
  int appendState(const PersonSpec& spec, const std::string& name);
  void joinGroup(int person);
  [[nodiscard]] Eigen::Vector2d placeable(const PersonSpec& spec, const Eigen::Vector2d& p,
                                          const char* what) const;
  [[nodiscard]] Itinerary findWays(const PersonSpec& spec, const Eigen::Vector2d& start) const;

  // Deciding.
  [[nodiscard]] Walker& walkerOf(std::size_t i) {
    return walkers_[static_cast<std::size_t>(movers_[i].source)];
  }
  [[nodiscard]] bool reacts(std::size_t i) const;  // walks and avoids others, now
  void decide(const RobotDisc& robot);
  void takeSnapshot();
  void decideFor(std::size_t i, const RobotDisc& robot);
  void findNeighbors(std::size_t i);
  [[nodiscard]] Eigen::Vector2d orcaChoice(std::size_t i, const Eigen::Vector2d& preferred,
                                           const RobotDisc& robot);
  [[nodiscard]] Eigen::Vector2d socialForceChoice(std::size_t i, const Eigen::Vector2d& preferred,
                                                  const RobotDisc& robot);
  [[nodiscard]] Eigen::Vector2d keptSolid(std::size_t i, const Eigen::Vector2d& wanted,
                                          const RobotDisc& robot);
  [[nodiscard]] Eigen::Vector2d keepUpWithGroup(std::size_t i, const Eigen::Vector2d& preferred);
  [[nodiscard]] Eigen::Vector2d separation(std::size_t i, const RobotDisc& robot) const;
  void resolveStandOff(std::size_t i, const RobotDisc& robot);
  void walkAround(std::size_t i, const RobotDisc& robot);
  void makeRoom(std::size_t i, std::size_t oncoming);
  void tryToReturn(std::size_t i, const RobotDisc& robot);

  // Moving.
  void move(double dt, const RobotDisc& robot);
  void walk(std::size_t i, double dt, const RobotDisc& robot);
  void followTimetable(std::size_t i, double dt);
  void followRecording(std::size_t i, double dt);
  void turnAndStride(PersonState& person, double distance, double dt) const;

  CrowdParams params_;
  const StaticMap* map_;                  // null: open space
  std::shared_ptr<const Router> router_;  // null: open space
  std::shared_ptr<const WallIndex> walls_;
  double time_ = 0.0;            // [s]
  std::uint64_t decisions_ = 0;  // taken so far
  double decision_time_ = 0.0;   // [s] of the present one, the same however long the steps are
  double until_decision_ = 0.0;  // [s]

  std::vector<PersonState> people_;
  std::vector<Mover> movers_;  // one a person
  std::vector<Walker> walkers_;
  std::vector<Itinerary> itineraries_;  // of scripted people
  std::vector<RecordedPerson> recorded_;
  std::vector<std::vector<int>> groups_;  // members by person index

  // Working memory of a decision.
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> present_;
  std::vector<MovingDisc> snapshot_;
  NeighborGrid grid_;
  std::vector<Near> near_;
  std::vector<OrcaNeighbor> neighbors_;
  std::vector<WallEdge> near_walls_;
  std::vector<Eigen::Vector2d> fellows_;
  OrcaSolver solver_;
};

}  // namespace kobuki_sim
