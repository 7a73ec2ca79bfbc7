// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/base_events.h"

#include <kobuki_msgs/SensorState.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace kobuki_sim {
namespace {

using kobuki_msgs::BumperEvent;
using kobuki_msgs::ButtonEvent;
using kobuki_msgs::CliffEvent;
using kobuki_msgs::PowerSystemEvent;
using kobuki_msgs::SensorState;
using kobuki_msgs::WheelDropEvent;

constexpr double kPercentOfDangerous = 5.0;

struct SideBit {
  std::uint8_t bit;     // in the packet
  std::uint8_t number;  // in the event
  std::size_t bottom;   // index in SensorPacket::bottom
};
constexpr std::array<SideBit, 3> kSides = {{{kLeftBit, 0, 2}, {kCentreBit, 1, 1}, {kRightBit, 2, 0}}};
constexpr std::array<SideBit, 2> kWheels = {
    {{kLeftWheelDropBit, WheelDropEvent::LEFT, 0}, {kRightWheelDropBit, WheelDropEvent::RIGHT, 0}}};

bool differs(std::uint8_t before, std::uint8_t now, std::uint8_t bit) { return ((before ^ now) & bit) != 0; }
std::uint8_t stateOf(std::uint8_t bits, std::uint8_t bit) { return (bits & bit) != 0 ? 1 : 0; }

void addBumperChanges(const SensorPacket& before, const SensorPacket& now, BaseEvents& events) {
  for (const auto& side : kSides) {
    if (!differs(before.bumper, now.bumper, side.bit)) continue;
    BumperEvent event;
    event.bumper = side.number;
    event.state = stateOf(now.bumper, side.bit);
    events.bumper.push_back(event);
  }
}

void addCliffChanges(const SensorPacket& before, const SensorPacket& now, BaseEvents& events) {
  for (const auto& side : kSides) {
    if (!differs(before.cliff, now.cliff, side.bit)) continue;
    CliffEvent event;
    event.sensor = side.number;
    event.state = stateOf(now.cliff, side.bit);
    event.bottom = now.bottom.at(side.bottom);
    events.cliff.push_back(event);
  }
}

void addWheelDropChanges(const SensorPacket& before, const SensorPacket& now, BaseEvents& events) {
  for (const auto& wheel : kWheels) {
    if (!differs(before.wheel_drop, now.wheel_drop, wheel.bit)) continue;
    WheelDropEvent event;
    event.wheel = wheel.number;
    event.state = stateOf(now.wheel_drop, wheel.bit);
    events.wheel_drop.push_back(event);
  }
}

void addButtonChanges(const SensorPacket& before, const SensorPacket& now, BaseEvents& events) {
  for (std::uint8_t button = ButtonEvent::Button0; button <= ButtonEvent::Button2; ++button) {
    const auto bit = static_cast<std::uint8_t>(1U << button);
    if (!differs(before.buttons, now.buttons, bit)) continue;
    ButtonEvent event;
    event.button = button;
    event.state = stateOf(now.buttons, bit);
    events.button.push_back(event);
  }
}

std::uint8_t chargerEvent(std::uint8_t charger) {
  switch (charger) {
    case SensorState::DISCHARGING:
      return PowerSystemEvent::UNPLUGGED;
    case SensorState::DOCKING_CHARGED:
    case SensorState::ADAPTER_CHARGED:
      return PowerSystemEvent::CHARGE_COMPLETED;
    case SensorState::DOCKING_CHARGING:
      return PowerSystemEvent::PLUGGED_TO_DOCKBASE;
    default:
      return PowerSystemEvent::PLUGGED_TO_ADAPTER;
  }
}

void addPowerChanges(const SensorPacket& before, const SensorPacket& now, const NodeParams& params,
                     BaseEvents& events) {
  PowerSystemEvent event;
  if (before.charger != now.charger) {
    event.event = chargerEvent(now.charger);
    events.power_system.push_back(event);
  }
  const BatteryLevel level = batteryLevel(now, params);
  if (level == batteryLevel(before, params) || level == BatteryLevel::kHealthy) return;
  event.event =
      level == BatteryLevel::kLow ? PowerSystemEvent::BATTERY_LOW : PowerSystemEvent::BATTERY_CRITICAL;
  events.power_system.push_back(event);
}

void addDigitalInputChanges(const SensorPacket& before, const SensorPacket& now, BaseEvents& events) {
  if (before.digital_input == now.digital_input) return;
  kobuki_msgs::DigitalInputEvent event;
  for (std::size_t i = 0; i < event.values.size(); ++i) {
    event.values[i] = static_cast<std::uint8_t>((now.digital_input >> i) & 1U);
  }
  events.digital_input.push_back(event);
}

}  // namespace

double batteryVoltage(const SensorPacket& packet) { return 0.1 * packet.battery; }

BatteryLevel batteryLevel(const SensorPacket& packet, const NodeParams& params) {
  if (packet.charger != SensorState::DISCHARGING) return BatteryLevel::kHealthy;
  if (batteryVoltage(packet) < params.battery_dangerous) return BatteryLevel::kDangerous;
  return batteryVoltage(packet) < params.battery_low ? BatteryLevel::kLow : BatteryLevel::kHealthy;
}

double batteryPercent(const SensorPacket& packet, const NodeParams& params) {
  const double above = batteryVoltage(packet) - params.battery_dangerous;
  const double full = params.battery_capacity - params.battery_dangerous;
  return std::clamp((100.0 - kPercentOfDangerous) * above / full + kPercentOfDangerous, 0.0, 100.0);
}

BaseEvents changes(const SensorPacket& before, const SensorPacket& now, const NodeParams& params) {
  BaseEvents events;
  addBumperChanges(before, now, events);
  addCliffChanges(before, now, events);
  addWheelDropChanges(before, now, events);
  addButtonChanges(before, now, events);
  addPowerChanges(before, now, params, events);
  addDigitalInputChanges(before, now, events);
  return events;
}

}  // namespace kobuki_sim
