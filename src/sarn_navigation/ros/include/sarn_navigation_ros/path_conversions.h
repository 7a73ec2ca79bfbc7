// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Path.h>
#include <sarn_msgs/NavigationStatus.h>
#include <sarn_msgs/TimedTrajectory.h>

#include <string>

#include "sarn_common/timed_trajectory.h"
#include "sarn_navigation/navigator.h"

namespace sarn_navigation {

/// The poses of a trajectory, each stamped with its time.
[[nodiscard]] nav_msgs::Path toPath(const sarn::TimedTrajectory& trajectory, const std::string& frame);

[[nodiscard]] sarn_msgs::NavigationStatus toMessage(const NavigatorStatus& status, const std::string& frame,
                                                    const ros::Time& stamp);

/// The status's value in sarn_msgs/TimedTrajectory.
[[nodiscard]] std::uint8_t toMessage(lattice_planner::PlanStatus status);

}  // namespace sarn_navigation
