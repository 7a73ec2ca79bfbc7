// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_diagnostics.h"

#include "sarn_navigation_ros/search_diagnostics.h"

namespace sarn_navigation {

NavigatorDiagnostics::NavigatorDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                                           double allowed_age)
    : health_(allowed_age), updater_(nh, private_nh) {
  updater_.setHardwareID("none");
  updater_.add("planning", this, &NavigatorDiagnostics::fill);
}

void NavigatorDiagnostics::update(const NavigatorStatus& status, double plan_age,
                                  const std::string& input_problem) {
  status_ = status;
  plan_age_ = plan_age;
  input_problem_ = input_problem;
  updater_.update();
}

void NavigatorDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& message) {
  summarize(health_.judge(status_, plan_age_, input_problem_), message);
  addFigures(figuresOf(status_, plan_age_), message);
  message.add("people near", status_.people_near);
  if (status_.distance_to_goal >= 0.0) message.add("distance to goal [m]", status_.distance_to_goal);
}

}  // namespace sarn_navigation
