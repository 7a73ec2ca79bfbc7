// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/time.h>

#include "kobuki_sim/kobuki_base.h"
#include "kobuki_sim_ros/parameters.h"

namespace kobuki_sim {

/// The ten statuses of a Kobuki, named as its nodelet names them, so that a diagnostic aggregator set up for
/// the robot finds them.
[[nodiscard]] diagnostic_msgs::DiagnosticArray toDiagnostics(const KobukiBase& base, const NodeParams& params,
                                                             const ros::Time& stamp);

}  // namespace kobuki_sim
