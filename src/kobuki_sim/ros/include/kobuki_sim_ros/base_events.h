// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <kobuki_msgs/BumperEvent.h>
#include <kobuki_msgs/ButtonEvent.h>
#include <kobuki_msgs/CliffEvent.h>
#include <kobuki_msgs/DigitalInputEvent.h>
#include <kobuki_msgs/PowerSystemEvent.h>
#include <kobuki_msgs/WheelDropEvent.h>

#include <vector>

#include "kobuki_sim/kobuki_sensors.h"
#include "kobuki_sim_ros/parameters.h"

namespace kobuki_sim {

/// What changed from one packet to the next. Events number left, centre, right as 0, 1, 2, while the packet's
/// bits are right 1, centre 2, left 4. CliffEvent::bottom is the reading of the sensor the event names.
struct BaseEvents {
  std::vector<kobuki_msgs::BumperEvent> bumper;
  std::vector<kobuki_msgs::CliffEvent> cliff;
  std::vector<kobuki_msgs::WheelDropEvent> wheel_drop;
  std::vector<kobuki_msgs::ButtonEvent> button;
  std::vector<kobuki_msgs::PowerSystemEvent> power_system;
  std::vector<kobuki_msgs::DigitalInputEvent> digital_input;
};

[[nodiscard]] BaseEvents changes(const SensorPacket& before, const SensorPacket& now,
                                 const NodeParams& params);

enum class BatteryLevel { kHealthy, kLow, kDangerous };
[[nodiscard]] BatteryLevel batteryLevel(const SensorPacket& packet, const NodeParams& params);
/// 5 at the dangerous voltage, 100 when full; in [0, 100].
[[nodiscard]] double batteryPercent(const SensorPacket& packet, const NodeParams& params);
[[nodiscard]] double batteryVoltage(const SensorPacket& packet);  // [V]

}  // namespace kobuki_sim
