// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kobuki_sim/kobuki_base.h"
#include "kobuki_sim_ros/parameters.h"

namespace kobuki_sim {

/// Begins or ends an event at the base: cliff_left, cliff_center, cliff_right, wheel_drop_left,
/// wheel_drop_right, button0, button1, button2, battery_low (ending it fills the battery to its charge at the
/// start). Returns one line that says what is wrong, empty when nothing is.
std::string injectEvent(KobukiBase& base, const NodeParams& params, const std::string& event, bool active);

}  // namespace kobuki_sim
