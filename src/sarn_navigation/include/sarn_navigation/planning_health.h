// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "sarn_navigation/navigator.h"

namespace sarn_navigation {

/// Values as in diagnostic_msgs/DiagnosticStatus.
enum class HealthLevel { kOk = 0, kWarn = 1, kError = 2 };

struct Health {
  HealthLevel level = HealthLevel::kOk;
  std::string summary;  // one line
};

/// What searches did, whoever asks for them: the navigator, or move_base.
struct SearchFigures {
  double planning_time = 0.0;  // [s] wall time of the last search
  std::size_t expansions = 0;  // of the last search
  double bound =
      std::numeric_limits<double>::infinity();  // cost of its plan <= bound * optimum; infinite: none
  unsigned deadline_misses = 0;  // searches since the goal was set that reached their time limit
  double plan_age = -1.0;        // [s] since a search last gave a plan; negative: no plan is driven
};

/// How searches go.
class SearchHealth {
 public:
  /// `allowed_age` [s]: a plan that is driven while no search has given one for longer is stale.
  explicit SearchHealth(double allowed_age) : allowed_age_(allowed_age) {}

  /// Judges the time since the last call. Nothing: all is well.
  [[nodiscard]] std::optional<Health> judge(const SearchFigures& figures);

 private:
  double allowed_age_;
  unsigned deadline_misses_ = 0;
};

/// How the navigator's planning goes, for somebody who looks at the robot from afar.
class PlanningHealth {
 public:
  /// `allowed_age` [s] as SearchHealth's.
  explicit PlanningHealth(double allowed_age) : searches_(allowed_age) {}

  /// Judges the time since the last call. `plan_age` [s], negative: no plan is driven. `input_problem`: why
  /// the robot cannot be controlled at all; empty: it can.
  [[nodiscard]] Health judge(const NavigatorStatus& status, double plan_age,
                             const std::string& input_problem);

 private:
  SearchHealth searches_;
};

[[nodiscard]] SearchFigures figuresOf(const NavigatorStatus& status, double plan_age);

}  // namespace sarn_navigation
