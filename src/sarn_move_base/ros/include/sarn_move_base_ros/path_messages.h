// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <string>
#include <vector>

#include "sarn_move_base/timed_plan.h"

// Plans <-> nav_core's vectors of poses. Any pose's frame is that of the plan; the stamp is the pose's time.
namespace sarn_move_base {

[[nodiscard]] std::vector<geometry_msgs::PoseStamped> toMessages(const TimedPlan& plan,
                                                                 const std::string& frame);

/// Throws std::invalid_argument that names the pose at fault: not finite, tilted, or of another frame than
/// the first pose's.
[[nodiscard]] std::vector<StampedPose> fromMessages(const std::vector<geometry_msgs::PoseStamped>& plan);

}  // namespace sarn_move_base
