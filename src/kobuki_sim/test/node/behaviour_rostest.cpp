// SPDX-License-Identifier: BSD-3-Clause
// What the base does with commands, walls and services.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <kobuki_msgs/BumperEvent.h>
#include <kobuki_msgs/CliffEvent.h>
#include <kobuki_msgs/MotorPower.h>
#include <kobuki_msgs/WheelDropEvent.h>
#include <rosgraph_msgs/Clock.h>
#include <sarn_msgs/Contact.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Empty.h>

#include <cmath>
#include <limits>

#include "sim_fixture.h"

namespace kobuki_sim {
namespace {

constexpr double kStartX = 2.5;          // [m] of the scenario
constexpr double kWallX = 5.9;           // [m]
constexpr double kHullRadius = 0.17575;  // [m]

using Behaviour = PausedSim;

TEST_F(Behaviour, stopsZeroPointSixToZeroPointSevenSecondsAfterTheLastCommand) {
  command(0.3, 0.0);
  ASSERT_TRUE(stepUntil([this] { return speed() > 0.01; }, 5.0)) << "the robot never moved";
  double moving = 0.0;
  ASSERT_TRUE(stepUntil(
      [&] {
        moving += 0.02;
        return std::abs(speed()) < 0.01;
      },
      5.0))
      << "the robot never stopped";
  // 0.6 s, up to 0.1 s until the watchdog looks, then 0.15 s to brake; the delay counts at both ends.
  EXPECT_GE(moving, 0.6);
  EXPECT_LE(moving, 0.6 + 0.1 + 0.15 + 0.08);
}

TEST_F(Behaviour, keepsDrivingWhileCommandsCome) {
  ASSERT_TRUE(driveUntil(0.3, 0.0, [this] { return x() > kStartX + 0.6; }, 5.0));
  EXPECT_NEAR(speed(), 0.3, 0.03);
}

TEST_F(Behaviour, standsStillAtATwistWithNanAndTakesTheNextOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(driveUntil(0.3, 0.0, [this] { return speed() > 0.25; }, 5.0));
  ASSERT_TRUE(driveUntil(nan, 0.0, [this] { return std::abs(speed()) < 0.01; }, 5.0));
  for (const auto& message : truth_.messages) ASSERT_TRUE(std::isfinite(message.pose.pose.position.x));
  ASSERT_TRUE(driveUntil(0.3, nan, [this] { return std::abs(speed()) < 0.01; }, 5.0));
  EXPECT_TRUE(driveUntil(0.3, 0.0, [this] { return speed() > 0.25; }, 5.0));
}

TEST_F(Behaviour, ignoresVelocitiesWhileTheMotorsAreOff) {
  auto power = nh_.advertise<kobuki_msgs::MotorPower>("/mobile_base/commands/motor_power", 1);
  const Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(await([&] { return power.getNumSubscribers() > 0; }));
  ASSERT_TRUE(diagnostics.awaitConnection());
  const auto motorsSay = [&](const std::string& state) {
    if (diagnostics.messages.empty()) return false;
    for (const auto& status : diagnostics.messages.back().status) {
      if (status.name == "mobile_base_nodelet_manager: Motor State")
        return status.values.at(0).value == state;
    }
    return false;
  };
  kobuki_msgs::MotorPower message;
  message.state = kobuki_msgs::MotorPower::OFF;
  power.publish(message);
  ASSERT_TRUE(stepUntil([&] { return motorsSay("off"); }, 10.0));
  const double before = x();
  EXPECT_FALSE(driveUntil(0.3, 0.0, [&] { return std::abs(x() - before) > 1e-3; }, 1.0));
  message.state = kobuki_msgs::MotorPower::ON;
  power.publish(message);
  ASSERT_TRUE(stepUntil([&] { return motorsSay("on"); }, 10.0));
  EXPECT_TRUE(driveUntil(0.3, 0.0, [&] { return x() > before + 0.1; }, 5.0));
}

TEST_F(Behaviour, bumpsIntoAWallAndSaysSo) {
  const Recorder<kobuki_msgs::BumperEvent> bumper("/mobile_base/events/bumper");
  const Recorder<sarn_msgs::Contact> contacts("/ground_truth/contacts");
  const Recorder<sensor_msgs::PointCloud2> cloud("/mobile_base/sensors/bumper_pointcloud");
  ASSERT_TRUE(bumper.awaitConnection() && contacts.awaitConnection() && cloud.awaitConnection());
  ASSERT_TRUE(driveUntil(0.5, 0.0, [&] { return !bumper.messages.empty(); }, 20.0));
  EXPECT_EQ(bumper.messages[0].bumper, kobuki_msgs::BumperEvent::CENTER);
  EXPECT_EQ(bumper.messages[0].state, kobuki_msgs::BumperEvent::PRESSED);
  EXPECT_NEAR(x(), kWallX - kHullRadius, 0.01);
  ASSERT_TRUE(contacts.awaitCount(1));
  EXPECT_EQ(contacts.messages[0].other, "wall");
  EXPECT_NEAR(contacts.messages[0].point.x, kWallX, 0.01);
  EXPECT_NEAR(contacts.messages[0].robot_closing_speed, 0.5, 0.05);
  ASSERT_TRUE(cloud.awaitCount(1));
  ASSERT_TRUE(driveUntil(-0.3, 0.0, [&] { return bumper.messages.size() >= 2; }, 5.0));
  EXPECT_EQ(bumper.messages[1].state, kobuki_msgs::BumperEvent::RELEASED);
  EXPECT_EQ(contacts.messages.size(), 1U) << "one contact, one event";
}

TEST_F(Behaviour, resetOdometryZeroesThePoseAndNotTheTruth) {
  auto reset = nh_.advertise<std_msgs::Empty>("/mobile_base/commands/reset_odometry", 1);
  const Recorder<nav_msgs::Odometry> odometry("/odom");
  ASSERT_TRUE(await([&] { return reset.getNumSubscribers() > 0; }));
  ASSERT_TRUE(odometry.awaitConnection());
  ASSERT_TRUE(driveUntil(0.3, 0.5, [this] { return x() > kStartX + 0.3; }, 10.0));
  ASSERT_TRUE(stepUntil([this] { return std::abs(speed()) < 1e-3; }, 5.0));
  ASSERT_TRUE(odometry.awaitCount(truth_.messages.size()));
  EXPECT_GT(odometry.messages.back().pose.pose.position.x, 0.2);
  reset.publish(std_msgs::Empty());
  ASSERT_TRUE(stepUntil(
      [&] {
        const auto& pose = odometry.messages.back().pose.pose;
        return std::abs(pose.position.x) < 1e-3 && std::abs(pose.position.y) < 1e-3 &&
               std::abs(pose.orientation.z) < 1e-3;
      },
      5.0));
  EXPECT_GT(x(), kStartX + 0.3);
}

TEST_F(Behaviour, resetStartsANewEpisodeWhileTheClockRunsOn) {
  const Recorder<rosgraph_msgs::Clock> clock("/clock");
  ASSERT_TRUE(clock.awaitConnection());
  ASSERT_TRUE(driveUntil(0.3, 0.0, [this] { return x() > kStartX + 0.3; }, 10.0));
  const ros::Time before = step(0);
  sarn_msgs::Reset reset;
  reset.request.seed = 99;
  ASSERT_TRUE(sarn::callService("/kobuki_sim/reset", reset));
  EXPECT_TRUE(reset.response.success);
  EXPECT_NE(reset.response.message.find("99"), std::string::npos);
  stepPacket();
  EXPECT_NEAR(x(), kStartX, 1e-6);
  EXPECT_EQ(robot().header.stamp, before + ros::Duration(0.02));
  ASSERT_TRUE(await([&] { return clock.messages.back().clock == before + ros::Duration(0.02); }));
  for (std::size_t i = 1; i < clock.messages.size(); ++i) {
    EXPECT_GE(clock.messages[i].clock, clock.messages[i - 1].clock);
  }
}

TEST_F(Behaviour, aSeedRepeatsAnEpisodeExactly) {
  const auto endOfDrive = [this] {
    sarn_msgs::Reset reset;
    reset.request.seed = 5;
    EXPECT_TRUE(sarn::callService("/kobuki_sim/reset", reset));
    const ros::Time start = step(0);
    Recorder<nav_msgs::Odometry> odometry("/odom");
    EXPECT_TRUE(odometry.awaitConnection());
    const ros::Time end = step(200);
    EXPECT_TRUE(
        await([&] { return !odometry.messages.empty() && odometry.messages.back().header.stamp == end; }));
    EXPECT_EQ(end, start + ros::Duration(2.0));
    return odometry.messages.back().pose.pose;
  };
  const auto first = endOfDrive();
  const auto second = endOfDrive();
  EXPECT_EQ(first.orientation.z, second.orientation.z) << "the gyro's noise comes from the seed";
}

TEST_F(Behaviour, stepsExactlyAsManyTimesAsAskedAndOnlyWhilePaused) {
  const ros::Time before = step(0);
  EXPECT_EQ(step(10), before + ros::Duration(0.1));
  EXPECT_EQ(step(1), before + ros::Duration(0.11));
  pause(false);
  sarn_msgs::Step call;
  call.request.steps = 1;
  ASSERT_TRUE(sarn::callService("/kobuki_sim/step", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_NE(call.response.message.find("pause"), std::string::npos);
}

TEST_F(Behaviour, theClockStandsWhilePausedAndIsStillTold) {
  const Recorder<rosgraph_msgs::Clock> clock("/clock");
  const ros::Time now = step(0);
  ASSERT_TRUE(clock.awaitCount(3));
  for (const auto& message : clock.messages) EXPECT_EQ(message.clock, now);
}

TEST_F(Behaviour, injectedEventsComeOutOfTheBase) {
  const Recorder<kobuki_msgs::CliffEvent> cliff("/mobile_base/events/cliff");
  const Recorder<kobuki_msgs::WheelDropEvent> wheel("/mobile_base/events/wheel_drop");
  ASSERT_TRUE(cliff.awaitConnection() && wheel.awaitConnection());
  stepPacket();
  EXPECT_TRUE(inject("cliff_left", true).success);
  EXPECT_TRUE(inject("wheel_drop_right", true).success);
  stepPacket();
  ASSERT_TRUE(cliff.awaitCount(1) && wheel.awaitCount(1));
  EXPECT_EQ(cliff.messages[0].sensor, kobuki_msgs::CliffEvent::LEFT);
  EXPECT_EQ(cliff.messages[0].state, kobuki_msgs::CliffEvent::CLIFF);
  EXPECT_EQ(wheel.messages[0].wheel, kobuki_msgs::WheelDropEvent::RIGHT);
  EXPECT_TRUE(inject("cliff_left", false).success);
  stepPacket();
  ASSERT_TRUE(cliff.awaitCount(2));
  EXPECT_EQ(cliff.messages[1].state, kobuki_msgs::CliffEvent::FLOOR);
  const auto refused = inject("earthquake", true);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("earthquake"), std::string::npos);
}

}  // namespace
}  // namespace kobuki_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "behaviour_rostest");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
