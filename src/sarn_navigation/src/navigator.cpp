// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/navigator.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "lattice_planner/commit.h"
#include "sarn_navigation/reachable_area.h"
#include "sarn_navigation/waiting_people.h"
#include "sarn_navigation/yield_spot.h"

namespace sarn_navigation {
namespace {

using lattice_planner::PlanStatus;

constexpr double kStandingSpeed = 0.05;     // [m/s]
constexpr double kStandingTurnRate = 0.10;  // [rad/s]
constexpr double kSettleTime = 0.3;         // [s] standing this long counts as standing
constexpr double kArrivalTime = 1.5;        // [s] before the end of a complete plan there is no new one
constexpr double kStayTime = 1.5;           // [s] a plan that does not move for this long is waiting
constexpr double kStayDistance = 0.10;      // [m]
constexpr double kYieldPause = 2.0;         // [s] between two attempts to move aside
constexpr double kYieldClearance = 0.9;     // [m] people this near to the old place have not passed yet
constexpr double kWaitingDistance = 0.8;    // [m] people wait this near to a robot in their way
constexpr double kExpectation = 0.5;        // [s] until costs know that they wait
constexpr double kClearTime = 2.0;          // [s] nobody wants to pass for this long: nobody does

double approach(double value, double step) {
  return value > 0.0 ? std::max(0.0, value - step) : std::min(0.0, value + step);
}

std::string at(const sarn::Pose2D& pose) {
  std::ostringstream text;
  text.precision(2);
  text << std::fixed << "(" << pose.x << ", " << pose.y << ")";
  return text.str();
}

}  // namespace

Navigator::Navigator(const NavigatorParams& params, const timed_path_follower::FollowerParams& follower,
                     PlanFunction plan, CostFunction cost, const lattice_planner::FootprintCheck& footprint)
    : params_(params),
      follower_(follower),
      yield_monitor_(params),
      recovery_(params),
      progress_(params.progress_distance),
      footprint_(footprint),
      cost_(std::move(cost)),
      worker_(std::move(plan)) {}

std::string Navigator::setGoal(const sarn::Pose2D& goal, const NavigatorInput& input) {
  const auto refuse = [this](PlanStatus status, std::string reason) {
    status_.plan_status = status;
    return reason;
  };
  if (!std::isfinite(goal.x) || !std::isfinite(goal.y) || !std::isfinite(goal.theta))
    return refuse(PlanStatus::kInvalidRequest, "goal is not finite");
  const auto cell = input.scene->geometry.cellAt(goal.x, goal.y);
  if (!cell) return refuse(PlanStatus::kGoalOutsideMap, "goal " + at(goal) + " is outside the map");
  const std::uint8_t cost = input.scene->static_costs[input.scene->geometry.index(*cell)];
  if (cost == sarn::kNoInformation)
    return refuse(PlanStatus::kGoalUnknown, "goal " + at(goal) + " is in unknown space");
  if (cost >= sarn::kInscribedObstacle)
    return refuse(PlanStatus::kGoalOccupied, "goal " + at(goal) + " is in an obstacle or too near to one");
  goal_ = goal;
  goal_lengths_ = pathLengths(*input.scene, goal.position());
  recovery_.reset();
  recoveries_ = 0;
  plan_failure_.clear();
  status_.deadline_misses = 0;
  progress_.reset(input.now);
  if (yield_) return {};  // first lets the person pass
  ++task_;
  next_plan_time_ = input.now;
  setState(NavigatorState::kPlanning);
  return {};
}

void Navigator::cancel() {
  goal_.reset();
  yield_.reset();
  recovery_.reset();
  dropPlan();
  status_.distance_to_goal = -1.0;
  setState(NavigatorState::kIdle);
}

void Navigator::reset() {
  cancel();
  yield_monitor_.clear();
  people_ = {};
  next_plan_time_ = yield_retry_time_ = still_since_ = 0.0;
}

void Navigator::observe(const sarn::PeoplePrediction& people) {
  people_ = people;
  yield_monitor_.observe(people);
  if (yield_) yield_->watch.observe(people);
}

sarn::PeoplePrediction Navigator::expected(const sarn::PeoplePrediction& people) const {
  return yield_ ? waitingInFrontOf(position_, kWaitingDistance, people) : people;
}

void Navigator::dropPlan() {
  trajectory_.points.clear();
  committed_.points.clear();
  follower_.clear();
  ++task_;  // a search that runs started from the dropped plan
}

void Navigator::setState(NavigatorState state, const std::string& reason) {
  status_.state = state;
  status_.reason = reason;
}

sarn::Twist2D Navigator::brake() const {
  const double dt = 1.0 / params_.controller_frequency;
  return {approach(last_command_.v, params_.acc_lim_x * dt),
          approach(last_command_.omega, params_.acc_lim_theta * dt)};
}

bool Navigator::standsStill(const NavigatorInput& input) const {
  return !moving_ && input.now - still_since_ >= kSettleTime;
}

double Navigator::distanceToGoal(const sarn::Pose2D& pose) const {
  const auto cell = goal_lengths_.geometry.cellAt(pose.x, pose.y);
  if (cell && goal_lengths_.at(*cell) != kUnreachable) return static_cast<double>(goal_lengths_.at(*cell));
  return (goal_->position() - pose.position()).norm();
}

sarn::Twist2D Navigator::step(const NavigatorInput& input) {
  last_command_ = decide(input);
  return last_command_;
}

sarn::Twist2D Navigator::decide(const NavigatorInput& input) {
  position_ = input.pose.position();
  const bool moves =
      std::abs(input.twist.v) > kStandingSpeed || std::abs(input.twist.omega) > kStandingTurnRate;
  if (moves) still_since_ = input.now;
  moving_ = moves;
  status_.people_near = static_cast<unsigned>(
      std::count_if(people_.people.begin(), people_.people.end(), [&](const sarn::PersonPrediction& person) {
        return !person.states.empty() &&
               (person.states.front().position - input.pose.position()).norm() < 3.0;
      }));
  adoptResult(input);
  superviseYield(input);
  if (!goal_ && !yield_) return brake();
  if (goal_) status_.distance_to_goal = distanceToGoal(input.pose);
  superviseProgress(input);
  if (!goal_ && !yield_) return brake();  // given up
  if (recovery_.active()) {
    const sarn::Twist2D command = recovery_.step(input.now, input.pose.theta);
    if (!recovery_.active()) {
      progress_.touch(input.now);
      next_plan_time_ = input.now;
    }
    return command;
  }
  superviseConflict(input);
  planWhenDue(input);
  return follow(input);
}

// --- planning
// ----------------------------------------------------------------------------------------------------

void Navigator::adoptResult(const NavigatorInput& input) {
  const auto result = worker_.poll();
  if (!result) return;
  status_.planning_time = result->search_time;
  status_.expansions = result->expansions;
  status_.bound = result->bound;
  if (result->timed_out) ++status_.deadline_misses;
  if (submitted_task_ != task_ || (!goal_ && !yield_))
    return;  // made for another goal or from a dropped plan
  status_.plan_status = result->status;
  if (lattice_planner::isDrivable(result->status) && !result->trajectory.empty()) {
    plan_failure_.clear();
    status_.plan_stamp = input.now;
    if (!keepsPlan(*result, input)) adoptPlan(*result);
    return;
  }
  plan_failure_ = lattice_planner::toString(result->status);
  if (trajectory_task_ != task_) dropPlan();  // what is driven leads to the last target, this one has no plan
  if (yield_ && !yield_->reached) endYield(input.now);
}

/// A plan that still leads to the goal is kept until a new one is clearly cheaper on the newest costs: a
/// robot that changes its mind at every search, between two sides to pass on, passes on neither and nobody
/// can read it.
bool Navigator::keepsPlan(const lattice_planner::PlanResult& result, const NavigatorInput& input) {
  const double release = result.trajectory.startTime();
  if (trajectory_task_ != task_) return false;  // it leads elsewhere
  if (!cost_ || committed_.empty() || trajectory_status_ != PlanStatus::kComplete) return false;
  if (trajectory_.endTime() <= release || conflictUntil(trajectory_.endTime(), input)) return false;
  if (result.status != PlanStatus::kComplete) return true;
  const double kept = cost_(trajectory_, *input.scene, release);
  const double offered = cost_(result.trajectory, *input.scene, release);
  return offered > params_.keep_plan_ratio * kept;
}

void Navigator::adoptPlan(const lattice_planner::PlanResult& result) {
  trajectory_ = committed_.empty() ? result.trajectory : lattice_planner::join(committed_, result.trajectory);
  trajectory_status_ = result.status;
  trajectory_task_ = task_;
  follower_.setTrajectory(trajectory_, target());
  ++plan_count_;
}

std::optional<sarn::TrajectoryPoint> Navigator::planStart(const NavigatorInput& input) {
  const double release = input.now + params_.release_delay;
  committed_ = lattice_planner::commit(trajectory_, input.now, release);
  if (!committed_.empty()) return committed_.points.back();
  if (moving_) return std::nullopt;  // brakes first
  return sarn::TrajectoryPoint{input.pose.x, input.pose.y, input.pose.theta, 0.0, 0.0, release};
}

void Navigator::planWhenDue(const NavigatorInput& input) {
  if (worker_.busy() || input.now < next_plan_time_) return;
  if (yield_ && yield_->reached) return;
  if (yield_ && input.scene == yield_->before && input.now - yield_->start < kExpectation) return;
  const bool arriving = !trajectory_.empty() && trajectory_status_ == PlanStatus::kComplete &&
                        trajectory_.endTime() - input.now < kArrivalTime && trajectory_task_ == task_;
  if (arriving) return;
  const auto start = planStart(input);
  if (!start) return;
  submitted_task_ = task_;
  next_plan_time_ = input.now + 1.0 / params_.planner_frequency;
  submit_time_ = input.now;
  worker_.submit({{*start, target(), params_.planning_timeout}, input.scene});
}

// --- supervision
// -------------------------------------------------------------------------------------------------

lattice_planner::FootprintCheck& Navigator::footprintIn(const NavigatorInput& input) {
  if (footprint_.active() && footprint_scene_ != input.scene) {
    footprint_scene_ = input.scene;
    footprint_.reset(*footprint_scene_);
  }
  return footprint_;
}

/// Of the trajectory that is being driven, from now on.
std::optional<Conflict> Navigator::conflictUntil(double end, const NavigatorInput& input) {
  return firstConflict(trajectory_, *input.scene, input.now, end, &footprintIn(input));
}

/// False: a robot that is not round would touch something in turning where it stands.
bool Navigator::mayTurn(const NavigatorInput& input) {
  lattice_planner::FootprintCheck& footprint = footprintIn(input);
  if (!footprint.active() || !input.scene->geometry.cellAt(input.pose.x, input.pose.y)) return true;
  constexpr int kHeadings = 36;
  for (int i = 0; i < kHeadings; ++i) {
    const double turn = 2.0 * sarn::kPi * i / kHeadings;
    if (!footprint.clearOfStatic({input.pose.x, input.pose.y, input.pose.theta + turn})) return false;
  }
  return true;
}

void Navigator::superviseConflict(const NavigatorInput& input) {
  if (trajectory_.empty()) return;
  const auto conflict = conflictUntil(input.now + params_.conflict_horizon, input);
  if (!conflict) return;
  next_plan_time_ = std::min(next_plan_time_, input.now);
  const double braking_time = std::abs(input.twist.v) / params_.acc_lim_x + params_.brake_margin;
  if (conflict->where.t - input.now > braking_time) return;
  dropPlan();
  setState(NavigatorState::kWaiting,
           conflict->with_people ? "somebody is in the way" : "an obstacle is in the way");
}

void Navigator::superviseProgress(const NavigatorInput& input) {
  if (!goal_ || yield_ || recovery_.active()) return;
  if (progress_.observe(input.now, status_.distance_to_goal)) recoveries_ = 0;
  const bool people_near =
      std::any_of(people_.people.begin(), people_.people.end(), [&](const sarn::PersonPrediction& person) {
        return !person.states.empty() &&
               (person.states.front().position - input.pose.position()).norm() < params_.people_near_distance;
      });
  const double patience = people_near ? params_.people_patience : params_.progress_timeout;
  if (progress_.stalledFor(input.now) < patience) return;
  if (people_near) {
    recoverOrGiveUp(input, "people block the way");
  } else {
    recoverOrGiveUp(input, plan_failure_.empty() ? "no progress" : plan_failure_);
  }
}

void Navigator::recoverOrGiveUp(const NavigatorInput& input, const std::string& reason) {
  dropPlan();
  if (recoveries_ >= params_.max_recoveries) {
    goal_.reset();
    status_.distance_to_goal = -1.0;
    setState(NavigatorState::kAborted, reason + " after " + std::to_string(recoveries_) + " recoveries");
    return;
  }
  ++recoveries_;
  recovery_.start(input.now, input.pose.theta, mayTurn(input));
  setState(NavigatorState::kRecovering, reason);
}

void Navigator::superviseYield(const NavigatorInput& input) {
  if (!params_.yield_enabled || recovery_.active()) return;
  if (yield_) {
    if (yield_->reached || distanceToWay(input.pose.position(), yield_->person) >= params_.yield_distance)
      yield_->watch.robotIsAside(input.now);
    if (!wayIsClear(input.now)) yield_->clear_since = input.now;
    const bool nobody_comes = input.now - yield_->clear_since > kClearTime;
    if (yield_->watch.seenBeyond() || nobody_comes || input.now - yield_->start > params_.yield_timeout)
      endYield(input.now);
    return;
  }
  if (!standsStill(input) || input.now < yield_retry_time_) return;
  const bool stays =
      trajectory_.empty() ||
      (trajectory_.sample(input.now + kStayTime).pose().position() - input.pose.position()).norm() <
          kStayDistance;
  if (!stays) return;
  if (const auto person = yield_monitor_.blockedBy(input.pose.position())) startYield(input, *person);
}

/// Nobody is on the way through the place where the robot stood.
bool Navigator::wayIsClear(double now) const {
  const bool somebody_there =
      std::any_of(people_.people.begin(), people_.people.end(), [&](const sarn::PersonPrediction& person) {
        return !person.states.empty() &&
               (person.states.front().position - yield_->origin).norm() < kYieldClearance;
      });
  return !yield_monitor_.blockedBy(yield_->origin) && !somebody_there && !yield_->watch.mayStillCome(now);
}

void Navigator::startYield(const NavigatorInput& input, const BlockedPerson& person) {
  yield_retry_time_ = input.now + kYieldPause;
  const auto spot = findYieldSpot(input.pose, person, *input.scene, params_);
  if (!spot) return;
  const Eigen::Vector2d origin = input.pose.position();
  yield_ = Yield{*spot,      person, origin, input.now, input.now, PassingWatch(person, origin, input.now),
                 input.scene};
  expectation_changed_ = true;
  dropPlan();
  next_plan_time_ = input.now;
  setState(NavigatorState::kYielding, "moves aside for " + person.name);
}

void Navigator::endYield(double now) {
  yield_.reset();
  expectation_changed_ = true;
  dropPlan();
  progress_.touch(now);
  next_plan_time_ = now;
  setState(goal_ ? NavigatorState::kPlanning : NavigatorState::kIdle);
}

// --- control
// -----------------------------------------------------------------------------------------------------

sarn::Twist2D Navigator::follow(const NavigatorInput& input) {
  if (trajectory_.empty()) {
    if (!yield_ && status_.state == NavigatorState::kDriving) setState(NavigatorState::kPlanning);
    if (!yield_ && !plan_failure_.empty()) setState(NavigatorState::kWaiting, plan_failure_);
    return brake();
  }
  const auto command = follower_.computeVelocity(input.pose, input.twist, input.now);
  switch (command.status) {
    case timed_path_follower::FollowStatus::kTracking: {
      const sarn::Pose2D soon = trajectory_.sample(input.now + kStayTime).pose();
      const bool stays = (soon.position() - input.pose.position()).norm() < kStayDistance &&
                         std::abs(sarn::angleDifference(soon.theta, input.pose.theta)) < 0.1;
      if (yield_) {
        status_.state = NavigatorState::kYielding;
      } else {
        setState(stays ? NavigatorState::kWaiting : NavigatorState::kDriving,
                 stays ? "waits for people to pass" : "");
      }
      return command.twist;
    }
    case timed_path_follower::FollowStatus::kGoalReached:
      if (trajectory_task_ != task_) {  // the last target's place
        dropPlan();
        next_plan_time_ = input.now;
      } else if (yield_) {
        yield_->reached = true;
      } else {
        goal_.reset();
        dropPlan();
        status_.distance_to_goal = 0.0;
        setState(NavigatorState::kSucceeded);
      }
      return {};
    default:  // deviated from the plan, or the plan ended before the goal: stop, plan from where the robot is
      if (!(yield_ && yield_->reached)) {
        dropPlan();
        next_plan_time_ = input.now;
      }
      return brake();
  }
}

}  // namespace sarn_navigation
