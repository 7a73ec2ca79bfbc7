// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/base_events.h"

#include <gtest/gtest.h>
#include <kobuki_msgs/SensorState.h>

namespace kobuki_sim {
namespace {

using kobuki_msgs::BumperEvent;
using kobuki_msgs::ButtonEvent;
using kobuki_msgs::CliffEvent;
using kobuki_msgs::PowerSystemEvent;
using kobuki_msgs::SensorState;
using kobuki_msgs::WheelDropEvent;

SensorPacket healthyPacket() {
  SensorPacket packet;
  packet.battery = 160;
  packet.bottom = {301, 302, 303};  // right, centre, left
  return packet;
}

class BaseEventsTest : public testing::Test {
 protected:
  [[nodiscard]] BaseEvents happened() const { return changes(before_, now_, params_); }
  [[nodiscard]] BaseEvents undone() const { return changes(now_, before_, params_); }
  SensorPacket before_ = healthyPacket();
  SensorPacket now_ = healthyPacket();
  NodeParams params_;
};

TEST_F(BaseEventsTest, nothingHappensWhenNothingChanges) {
  const BaseEvents events = happened();
  EXPECT_TRUE(events.bumper.empty() && events.cliff.empty() && events.wheel_drop.empty());
  EXPECT_TRUE(events.button.empty() && events.power_system.empty() && events.digital_input.empty());
}

TEST_F(BaseEventsTest, numbersBumpersTheOtherWayRoundThanTheBits) {
  const struct {
    std::uint8_t bit, number;
  } pads[] = {{SensorState::BUMPER_LEFT, BumperEvent::LEFT},
              {SensorState::BUMPER_CENTRE, BumperEvent::CENTER},
              {SensorState::BUMPER_RIGHT, BumperEvent::RIGHT}};
  for (const auto& pad : pads) {
    now_.bumper = pad.bit;
    ASSERT_EQ(happened().bumper.size(), 1U);
    EXPECT_EQ(happened().bumper[0].bumper, pad.number);
    EXPECT_EQ(happened().bumper[0].state, BumperEvent::PRESSED);
    ASSERT_EQ(undone().bumper.size(), 1U);
    EXPECT_EQ(undone().bumper[0].bumper, pad.number);
    EXPECT_EQ(undone().bumper[0].state, BumperEvent::RELEASED);
  }
}

TEST_F(BaseEventsTest, aCliffCarriesTheReadingOfItsOwnSensor) {
  now_.cliff = SensorState::CLIFF_LEFT | SensorState::CLIFF_RIGHT;
  const auto events = happened().cliff;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].sensor, CliffEvent::LEFT);
  EXPECT_EQ(events[0].bottom, 303);
  EXPECT_EQ(events[0].state, CliffEvent::CLIFF);
  EXPECT_EQ(events[1].sensor, CliffEvent::RIGHT);
  EXPECT_EQ(events[1].bottom, 301);
}

TEST_F(BaseEventsTest, wheelDropsNameTheirWheel) {
  now_.wheel_drop = SensorState::WHEEL_DROP_LEFT;
  ASSERT_EQ(happened().wheel_drop.size(), 1U);
  EXPECT_EQ(happened().wheel_drop[0].wheel, WheelDropEvent::LEFT);
  EXPECT_EQ(happened().wheel_drop[0].state, WheelDropEvent::DROPPED);
}

TEST_F(BaseEventsTest, eachButtonThatChangesIsAnEvent) {
  before_.buttons = SensorState::BUTTON0;
  now_.buttons = SensorState::BUTTON2;
  const auto events = happened().button;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].button, ButtonEvent::Button0);
  EXPECT_EQ(events[0].state, ButtonEvent::RELEASED);
  EXPECT_EQ(events[1].button, ButtonEvent::Button2);
  EXPECT_EQ(events[1].state, ButtonEvent::PRESSED);
}

TEST_F(BaseEventsTest, theBatteryIsReportedWhenItsLevelFalls) {
  now_.battery = 139;
  ASSERT_EQ(happened().power_system.size(), 1U);
  EXPECT_EQ(happened().power_system[0].event, PowerSystemEvent::BATTERY_LOW);
  before_ = now_;
  now_.battery = 138;
  EXPECT_TRUE(happened().power_system.empty()) << "still low";
  now_.battery = 131;
  ASSERT_EQ(happened().power_system.size(), 1U);
  EXPECT_EQ(happened().power_system[0].event, PowerSystemEvent::BATTERY_CRITICAL);
}

TEST_F(BaseEventsTest, theChargerIsReportedWhenItChanges) {
  now_.charger = SensorState::DOCKING_CHARGING;
  ASSERT_EQ(happened().power_system.size(), 1U);
  EXPECT_EQ(happened().power_system[0].event, PowerSystemEvent::PLUGGED_TO_DOCKBASE);
  ASSERT_EQ(undone().power_system.size(), 1U);
  EXPECT_EQ(undone().power_system[0].event, PowerSystemEvent::UNPLUGGED);
}

TEST_F(BaseEventsTest, digitalInputsAreReportedTogether) {
  now_.digital_input = SensorState::DIGITAL_INPUT1 | SensorState::DIGITAL_INPUT3;
  const auto events = happened().digital_input;
  ASSERT_EQ(events.size(), 1U);
  const boost::array<std::uint8_t, 4> expected = {{0, 1, 0, 1}};
  EXPECT_EQ(events[0].values, expected);
}

TEST_F(BaseEventsTest, percentIsFiveAtTheDangerousVoltageAndAHundredWhenFull) {
  now_.battery = 132;
  EXPECT_NEAR(batteryPercent(now_, params_), 5.0, 1e-9);
  now_.battery = 165;
  EXPECT_NEAR(batteryPercent(now_, params_), 100.0, 1e-9);
  now_.battery = 149;
  EXPECT_NEAR(batteryPercent(now_, params_), 95.0 * 1.7 / 3.3 + 5.0, 1e-9);
  now_.battery = 90;
  EXPECT_EQ(batteryPercent(now_, params_), 0.0);
  now_.battery = 200;
  EXPECT_EQ(batteryPercent(now_, params_), 100.0);
}

}  // namespace
}  // namespace kobuki_sim
