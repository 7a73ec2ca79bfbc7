// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <string>

#include "sarn_navigation/planning_health.h"

namespace sarn_navigation {

/// The navigator on /diagnostics, once a second.
class NavigatorDiagnostics {
 public:
  NavigatorDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, double allowed_age);

  /// To be called often; publishes when it is time. Arguments as PlanningHealth::judge's.
  void update(const NavigatorStatus& status, double plan_age, const std::string& input_problem);
  /// After a clock that jumped back: the next line is not waited for.
  void restart() { updater_.force_update(); }

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& message);

  PlanningHealth health_;
  NavigatorStatus status_;
  double plan_age_ = -1.0;  // [s]
  std::string input_problem_;
  diagnostic_updater::Updater updater_;
};

}  // namespace sarn_navigation
