// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cmath>

#include "sarn_navigation/planning_health.h"

namespace sarn_navigation {

inline void summarize(const Health& health, diagnostic_updater::DiagnosticStatusWrapper& message) {
  message.summary(static_cast<unsigned char>(health.level), health.summary);
}

/// One key each; what is not known has none.
inline void addFigures(const SearchFigures& figures, diagnostic_updater::DiagnosticStatusWrapper& message) {
  message.add("planning time [s]", figures.planning_time);
  message.add("expansions", figures.expansions);
  if (std::isfinite(figures.bound)) message.add("cost over optimum at most", figures.bound);
  if (figures.plan_age >= 0.0) message.add("plan age [s]", figures.plan_age);
  message.add("deadline misses", figures.deadline_misses);
}

}  // namespace sarn_navigation
