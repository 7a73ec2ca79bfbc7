// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "lattice_planner/footprint_check.h"
#include "sarn_common/people.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_common/timed_trajectory.h"
#include "sarn_navigation/navigator_params.h"
#include "sarn_navigation/passing_watch.h"
#include "sarn_navigation/plan_conflict.h"
#include "sarn_navigation/planning_worker.h"
#include "sarn_navigation/progress_monitor.h"
#include "sarn_navigation/recovery_sequence.h"
#include "sarn_navigation/yield_monitor.h"
#include "timed_path_follower/timed_path_follower.h"

namespace sarn_navigation {

/// Values as in sarn_msgs/NavigationStatus.
enum class NavigatorState {
  kIdle = 0,
  kPlanning = 1,
  kDriving = 2,
  kWaiting = 3,
  kYielding = 4,
  kRecovering = 5,
  kSucceeded = 6,
  kAborted = 7,
};

/// What the navigator knows at one control cycle; all in the planning frame.
struct NavigatorInput {
  double now = 0.0;                                     // [s]
  sarn::Pose2D pose;                                    // robot in the planning frame
  sarn::Twist2D twist;                                  // measured
  std::shared_ptr<const sarn::TimedCostmapView> scene;  // newest costs; not null
};

struct NavigatorStatus {
  NavigatorState state = NavigatorState::kIdle;
  std::string reason;              // why it waits, recovers or gave up
  double distance_to_goal = -1.0;  // [m] along the static map; -1: no goal
  lattice_planner::PlanStatus plan_status = lattice_planner::PlanStatus::kComplete;
  double planning_time = 0.0;  // [s] wall time of the last search
  double plan_stamp = 0.0;     // [s] when a search last gave a plan
  std::size_t expansions = 0;  // of the last search
  double bound =
      std::numeric_limits<double>::infinity();  // cost of its plan <= bound * optimum; infinite: none
  unsigned deadline_misses = 0;  // searches since the goal was set that reached their time limit
  unsigned people_near = 0;
};

/// Drives the robot to one goal at a time: plans ahead of time in a worker, joins each plan to the one being
/// driven, brakes and plans anew when people change their minds, waits for them, moves aside for them,
/// recovers, gives up. No ROS and no clock of its own: step() is called at controller_frequency.
class Navigator {
 public:
  /// `cost`: what `plan` minimises; without it every new plan is taken over. `footprint`: as the planner's.
  Navigator(const NavigatorParams& params, const timed_path_follower::FollowerParams& follower,
            PlanFunction plan, CostFunction cost = {}, const lattice_planner::FootprintCheck& footprint = {});

  /// Takes a goal, dropping any other. Returns why it is refused; empty: accepted.
  [[nodiscard]] std::string setGoal(const sarn::Pose2D& goal, const NavigatorInput& input);
  /// Brakes and forgets the goal.
  void cancel();
  /// Forgets plans, people and goal, as after a clock that jumped back.
  void reset();
  /// People as predicted, in the planning frame.
  void observe(const sarn::PeoplePrediction& people);
  /// What to expect of people, as a costmap should have it: while the robot moves aside, they wait for it.
  [[nodiscard]] sarn::PeoplePrediction expected(const sarn::PeoplePrediction& people) const;
  /// True once when what is expected of the same people has changed: costs are to be made anew.
  [[nodiscard]] bool takeExpectationChange() { return std::exchange(expectation_changed_, false); }

  /// One control cycle: the command to send.
  [[nodiscard]] sarn::Twist2D step(const NavigatorInput& input);

  [[nodiscard]] const NavigatorStatus& status() const { return status_; }
  [[nodiscard]] const sarn::TimedTrajectory& trajectory() const { return trajectory_; }
  /// Grows with each plan that is taken over.
  [[nodiscard]] unsigned planCount() const { return plan_count_; }
  [[nodiscard]] bool hasGoal() const { return goal_.has_value(); }
  [[nodiscard]] bool yielding() const { return yield_.has_value(); }
  /// True once when obstacles seen so far are to be forgotten.
  [[nodiscard]] bool takeClearRequest() { return recovery_.takeClearRequest(); }
  /// In a simulation faster than real time: blocks while a search runs whose plan is due at `now` [s].
  void waitForPlanDue(double now) const {
    if (now - submit_time_ >= params_.release_delay) worker_.wait();
  }

 private:
  struct Yield {
    sarn::Pose2D spot;
    BlockedPerson person;      // as when it began
    Eigen::Vector2d origin;    // [m] where the robot stood in the way
    double start = 0.0;        // [s]
    double clear_since = 0.0;  // [s] since when nobody is on the way through there
    PassingWatch watch;
    std::shared_ptr<const sarn::TimedCostmapView> before;  // costs in which people walk through the robot
    bool reached = false;
  };

  // Planning.
  void adoptResult(const NavigatorInput& input);
  [[nodiscard]] bool keepsPlan(const lattice_planner::PlanResult& result, const NavigatorInput& input);
  void adoptPlan(const lattice_planner::PlanResult& result);
  void planWhenDue(const NavigatorInput& input);
  [[nodiscard]] std::optional<sarn::TrajectoryPoint> planStart(const NavigatorInput& input);
  void dropPlan();
  [[nodiscard]] sarn::Pose2D target() const { return yield_ ? yield_->spot : *goal_; }
  [[nodiscard]] std::optional<Conflict> conflictUntil(double end, const NavigatorInput& input);
  [[nodiscard]] lattice_planner::FootprintCheck& footprintIn(const NavigatorInput& input);
  // Supervision.
  void superviseConflict(const NavigatorInput& input);
  void superviseProgress(const NavigatorInput& input);
  void recoverOrGiveUp(const NavigatorInput& input, const std::string& reason);
  void superviseYield(const NavigatorInput& input);
  void startYield(const NavigatorInput& input, const BlockedPerson& person);
  [[nodiscard]] bool wayIsClear(double now) const;
  void endYield(double now);
  [[nodiscard]] bool mayTurn(const NavigatorInput& input);
  [[nodiscard]] bool standsStill(const NavigatorInput& input) const;
  [[nodiscard]] double distanceToGoal(const sarn::Pose2D& pose) const;
  // Control.
  [[nodiscard]] sarn::Twist2D follow(const NavigatorInput& input);
  [[nodiscard]] sarn::Twist2D decide(const NavigatorInput& input);
  [[nodiscard]] sarn::Twist2D brake() const;
  void setState(NavigatorState state, const std::string& reason = {});

  NavigatorParams params_;
  timed_path_follower::TimedPathFollower follower_;
  YieldMonitor yield_monitor_;
  RecoverySequence recovery_;
  ProgressMonitor progress_;
  NavigatorStatus status_;
  sarn::PeoplePrediction people_;

  std::optional<sarn::Pose2D> goal_;
  std::optional<Yield> yield_;
  sarn::Grid<float> goal_lengths_;    // [m] way to the goal from each cell
  sarn::TimedTrajectory trajectory_;  // being driven; empty: none
  sarn::TimedTrajectory committed_;   // what is still driven of it while the search runs
  sarn::Twist2D last_command_;
  lattice_planner::PlanStatus trajectory_status_ = lattice_planner::PlanStatus::kComplete;
  unsigned plan_count_ = 0;
  unsigned task_ = 0;  // grows when target or base of planning change
  unsigned submitted_task_ = 0;
  unsigned trajectory_task_ = 0;   // whose target trajectory_ leads to
  double next_plan_time_ = 0.0;    // [s]
  double submit_time_ = 0.0;       // [s] when the last search began
  double yield_retry_time_ = 0.0;  // [s]
  double still_since_ = 0.0;       // [s]
  bool moving_ = false;
  bool expectation_changed_ = false;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();  // [m] of the robot at the last step
  int recoveries_ = 0;
  std::string plan_failure_;  // of the last search; empty: it gave a plan

  lattice_planner::FootprintCheck footprint_;
  std::shared_ptr<const sarn::TimedCostmapView> footprint_scene_;  // what it was reset to
  CostFunction cost_;
  PlanningWorker worker_;  // last member: its thread ends before the rest
};

}  // namespace sarn_navigation
