// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sarn_navigation/navigator.h"

namespace sarn_navigation {

/// Values as in diagnostic_msgs/DiagnosticStatus.
enum class HealthLevel { kOk = 0, kWarn = 1, kError = 2 };

struct Health {
  HealthLevel level = HealthLevel::kOk;
  std::string summary;  // one line
};

/// How planning goes, for somebody who looks at the robot from afar.
class PlanningHealth {
 public:
  /// `allowed_age` [s]: a plan that is driven while no search has given one for longer is stale.
  explicit PlanningHealth(double allowed_age) : allowed_age_(allowed_age) {}

  /// Judges the time since the last call. `plan_age` [s], negative: no plan is driven. `input_problem`: why
  /// the robot cannot be controlled at all; empty: it can.
  [[nodiscard]] Health judge(const NavigatorStatus& status, double plan_age,
                             const std::string& input_problem);

 private:
  double allowed_age_;
  unsigned deadline_misses_ = 0;
};

}  // namespace sarn_navigation
