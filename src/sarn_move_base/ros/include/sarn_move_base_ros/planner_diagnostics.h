// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <mutex>
#include <string>

#include "sarn_move_base/plan_continuation.h"
#include "sarn_navigation/planning_health.h"

namespace sarn_move_base {

/// A planner on /diagnostics, once a second of wall time: how its searches go, and why it last had no plan.
class PlannerDiagnostics {
 public:
  /// `name` of the entry. `allowed_age` [s]: a plan that is driven while plans have been asked for so long
  /// and no search gave one is stale.
  PlannerDiagnostics(const std::string& name, double allowed_age);

  /// Any thread, after each time a plan was asked for at `now` [s]. `failure`: why there is none; empty:
  /// there is `plan`.
  void note(double now, const ContinuedPlan& plan, const sarn::Pose2D& goal, const std::string& failure);
  /// Any thread: it was not even possible to search.
  void noteProblem(double now, const std::string& problem);

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& message);

  std::mutex mutex_;  // everything below but the last two
  sarn_navigation::SearchHealth health_;
  sarn_navigation::SearchFigures figures_;  // plan_age: filled in when told
  sarn::Pose2D goal_;                       // whose searches are counted
  std::string failure_;                     // of the last call
  double asked_ = -1.0;                     // [s] when a plan was last asked for; negative: never
  double planned_ = -1.0;                   // [s] when a search last gave a plan; negative: never
  double plan_end_ = -1.0;                  // [s] when the robot is at the end of the last plan

  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace sarn_move_base
