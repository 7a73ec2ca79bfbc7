// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/injected_events.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace kobuki_sim {
namespace {

std::uint8_t withBit(std::uint8_t bits, std::uint8_t bit, bool set) {
  return static_cast<std::uint8_t>(set ? bits | bit : bits & ~bit);
}

/// Halfway between low and dangerous, at rest.
double lowCharge(const KobukiParams& base, const NodeParams& params) {
  const double voltage = 0.5 * (params.battery_low + params.battery_dangerous);
  const double charge = (voltage - base.battery_empty) / (base.battery_full - base.battery_empty);
  return std::clamp(charge, 0.0, 1.0);
}

}  // namespace

std::string injectEvent(KobukiBase& base, const NodeParams& params, const std::string& event, bool active) {
  static const std::map<std::string, std::uint8_t> kCliffs = {
      {"cliff_left", kLeftBit}, {"cliff_center", kCentreBit}, {"cliff_right", kRightBit}};
  static const std::map<std::string, std::uint8_t> kWheelDrops = {{"wheel_drop_left", kLeftWheelDropBit},
                                                                  {"wheel_drop_right", kRightWheelDropBit}};
  static const std::map<std::string, std::uint8_t> kButtons = {
      {"button0", 1}, {"button1", 2}, {"button2", 4}};
  if (const auto cliff = kCliffs.find(event); cliff != kCliffs.end()) {
    base.setCliff(withBit(base.cliff(), cliff->second, active));
  } else if (const auto wheel = kWheelDrops.find(event); wheel != kWheelDrops.end()) {
    base.setWheelDrop(withBit(base.wheelDrop(), wheel->second, active));
  } else if (const auto button = kButtons.find(event); button != kButtons.end()) {
    base.setButtons(withBit(base.buttons(), button->second, active));
  } else if (event == "battery_low") {
    base.setBatteryCharge(active ? lowCharge(base.params(), params) : base.params().battery_charge);
  } else {
    return "event '" + event +
           "' is unknown; must be cliff_{left,center,right}, wheel_drop_{left,right}, button{0,1,2} or "
           "battery_low";
  }
  return {};
}

}  // namespace kobuki_sim
