// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/base_diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "kobuki_sim_ros/base_events.h"

namespace kobuki_sim {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr int kCurrentLimit = 6;  // [10 mA] of a motor: more looks like a robot that is stuck

DiagnosticStatus makeStatus(const std::string& task, bool fine, const std::string& when_fine,
                            const std::string& otherwise) {
  DiagnosticStatus status;
  status.name = "mobile_base_nodelet_manager: " + task;
  status.hardware_id = "Kobuki";
  status.level = fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
  status.message = fine ? when_fine : otherwise;
  return status;
}

void add(DiagnosticStatus& status, const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = value;
  status.values.push_back(pair);
}

void add(DiagnosticStatus& status, const std::string& key, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  add(status, key, std::string(text));
}

void addSides(DiagnosticStatus& status, std::uint8_t bits, const char* active, const char* inactive) {
  add(status, "Left", std::string((bits & kLeftBit) != 0 ? active : inactive));
  add(status, "Center", std::string((bits & kCentreBit) != 0 ? active : inactive));
  add(status, "Right", std::string((bits & kRightBit) != 0 ? active : inactive));
}

DiagnosticStatus battery(const SensorPacket& packet, const NodeParams& params) {
  const BatteryLevel level = batteryLevel(packet, params);
  auto status = makeStatus("Battery", level == BatteryLevel::kHealthy, "Healthy", "Low");
  if (level == BatteryLevel::kDangerous) {
    status.level = DiagnosticStatus::ERROR;
    status.message = "Dangerously low";
  }
  add(status, "Voltage (V)", batteryVoltage(packet));
  add(status, "Percent", batteryPercent(packet, params));
  add(status, "Charger", std::to_string(packet.charger));
  return status;
}

DiagnosticStatus watchdog(const KobukiBase& base) {
  auto status = makeStatus("Watchdog", true, "Alive", "");
  add(status, "Command timeouts", std::to_string(base.timeoutCount()));
  return status;
}

DiagnosticStatus wallSensor(const SensorPacket& packet) {
  auto status = makeStatus("Wall Sensor", packet.bumper == 0, "All right", "Wall hit");
  addSides(status, packet.bumper, "pressed", "released");
  return status;
}

DiagnosticStatus cliffSensor(const SensorPacket& packet) {
  auto status = makeStatus("Cliff Sensor", packet.cliff == 0, "All right", "Cliff detected");
  addSides(status, packet.cliff, "cliff", "floor");
  return status;
}

DiagnosticStatus wheelDrop(const SensorPacket& packet) {
  auto status = makeStatus("Wheel Drop", packet.wheel_drop == 0, "All right", "Wheel dropped");
  add(status, "Left", std::string((packet.wheel_drop & kLeftWheelDropBit) != 0 ? "dropped" : "raised"));
  add(status, "Right", std::string((packet.wheel_drop & kRightWheelDropBit) != 0 ? "dropped" : "raised"));
  return status;
}

DiagnosticStatus motorCurrent(const SensorPacket& packet) {
  const int largest = std::max(packet.current[0], packet.current[1]);
  auto status = makeStatus("Motor Current", largest <= kCurrentLimit, "All right",
                           "Motor current very high: the robot may be stuck");
  add(status, "Left (10 mA)", std::to_string(packet.current[0]));
  add(status, "Right (10 mA)", std::to_string(packet.current[1]));
  return status;
}

DiagnosticStatus motorState(const KobukiBase& base) {
  auto status = makeStatus("Motor State", base.motorPower(), "Motors enabled", "Motors disabled");
  add(status, "State", std::string(base.motorPower() ? "on" : "off"));
  return status;
}

DiagnosticStatus gyroSensor(const KobukiBase& base) {
  auto status = makeStatus("Gyro Sensor", true, "Heading available", "");
  add(status, "Heading (rad)", base.odometry().gyroHeading());
  add(status, "Yaw rate (rad/s)", base.odometry().yawRate());
  return status;
}

DiagnosticStatus digitalInput(const SensorPacket& packet) {
  auto status = makeStatus("Digital Input", true, "All right", "");
  for (int i = 0; i < 4; ++i) {
    add(status, "Input " + std::to_string(i), std::to_string((packet.digital_input >> i) & 1));
  }
  return status;
}

DiagnosticStatus analogInput(const SensorPacket& packet) {
  auto status = makeStatus("Analog Input", true, "All right", "");
  for (std::size_t i = 0; i < packet.analog_input.size(); ++i) {
    add(status, "Input " + std::to_string(i), std::to_string(packet.analog_input[i]));
  }
  return status;
}

}  // namespace

diagnostic_msgs::DiagnosticArray toDiagnostics(const KobukiBase& base, const NodeParams& params,
                                               const ros::Time& stamp) {
  const SensorPacket& packet = base.packet();
  diagnostic_msgs::DiagnosticArray message;
  message.header.stamp = stamp;
  message.status = {battery(packet, params), watchdog(base),       wallSensor(packet), cliffSensor(packet),
                    wheelDrop(packet),       motorCurrent(packet), motorState(base),   gyroSensor(base),
                    digitalInput(packet),    analogInput(packet)};
  return message;
}

}  // namespace kobuki_sim
