// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/planner_diagnostics.h"

#include <algorithm>
#include <optional>

#include "sarn_navigation_ros/search_diagnostics.h"

namespace sarn_move_base {
namespace {

using sarn_navigation::Health;
using sarn_navigation::HealthLevel;

constexpr double kPeriod = 1.0;  // [s] wall time
constexpr double kIdle = 5.0;    // [s] nobody has asked for so long and no plan goes on: there is no goal

}  // namespace

PlannerDiagnostics::PlannerDiagnostics(const std::string& name, double allowed_age) : health_(allowed_age) {
  updater_.setHardwareID("none");
  updater_.add(name, this, &PlannerDiagnostics::fill);
  timer_ = ros::NodeHandle().createWallTimer(ros::WallDuration(kPeriod),
                                             [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void PlannerDiagnostics::note(double now, const ContinuedPlan& plan, const sarn::Pose2D& goal,
                              const std::string& failure) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool new_goal = goal.x != goal_.x || goal.y != goal_.y || goal.theta != goal_.theta;
  if (new_goal) figures_.deadline_misses = 0;
  goal_ = goal;
  asked_ = now;
  failure_ = failure;
  if (plan.search) {
    figures_.planning_time = plan.search->time;
    figures_.expansions = plan.search->expansions;
    figures_.bound = plan.search->bound;
    if (plan.search->timed_out) ++figures_.deadline_misses;
    if (plan.search->found) planned_ = now;
  }
  if (failure.empty()) plan_end_ = plan.result.trajectory.endTime();
}

void PlannerDiagnostics::noteProblem(double now, const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  asked_ = now;
  failure_ = problem;
}

void PlannerDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& message) {
  const double now = ros::Time::now().toSec();
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool driven = now <= plan_end_;
  figures_.plan_age = planned_ >= 0.0 ? std::max(0.0, asked_ - planned_) : -1.0;
  const std::optional<Health> searches = health_.judge(figures_);
  if (!driven && (asked_ < 0.0 || now - asked_ > kIdle)) {
    sarn_navigation::summarize({HealthLevel::kOk, "no goal"}, message);
  } else if (!failure_.empty()) {
    sarn_navigation::summarize({HealthLevel::kWarn, failure_}, message);
  } else {
    sarn_navigation::summarize(searches.value_or(Health{HealthLevel::kOk, "plans"}), message);
  }
  figures_.plan_age = driven ? std::max(0.0, now - planned_) : -1.0;
  addFigures(figures_, message);
}

}  // namespace sarn_move_base
