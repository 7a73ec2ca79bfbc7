// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/kobuki_base.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "kobuki_sim/base_command.h"
#include "kobuki_sim/kobuki_sensors.h"

namespace kobuki_sim {
namespace {

constexpr double kDt = 0.01;  // [s]
constexpr double kDegree = sarn::kPi / 180.0;

/// A base on a free floor.
struct FreeBase {
  explicit FreeBase(const KobukiParams& params = KobukiParams::ideal(), std::uint64_t seed = 1)
      : base(params, kDt, seed) {}

  void step() {
    const sarn::Twist2D twist = base.drive();
    pose = sarn::advance(pose, twist, kDt);
    base.settle(twist, false, 0);
  }
  /// Steps for a time [s], with the command repeated at every step.
  void drive(double v, double omega, double duration) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / kDt)); ++i) {
      base.commandVelocity(v, omega);
      step();
    }
  }
  void coast(double duration) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / kDt)); ++i) step();
  }

  KobukiBase base;
  sarn::Pose2D pose;
};

TEST(KobukiBase, drivesTheCommandedArcOnceItIsUpToSpeed) {
  FreeBase robot;
  robot.drive(0.4, 0.5, 1.0);
  const sarn::Pose2D before = robot.pose;
  robot.drive(0.4, 0.5, 2.0);
  const sarn::Pose2D expected = sarn::advance(before, {0.4, 0.5}, 2.0);
  EXPECT_NEAR(robot.pose.x, expected.x, 1e-9);
  EXPECT_NEAR(robot.pose.y, expected.y, 1e-9);
  EXPECT_NEAR(robot.pose.theta, expected.theta, 1e-9);
}

TEST(KobukiBase, wheelsAccelerateWithinTheirLimits) {
  KobukiParams params = KobukiParams::ideal();
  params.wheel_acceleration = 0.5;
  params.wheel_deceleration = 1.0;
  FreeBase robot(params);
  double last = 0.0;
  double fastest_gain = 0.0;
  for (int i = 0; i < 200; ++i) {
    robot.drive(0.5, 0.0, kDt);
    fastest_gain = std::max(fastest_gain, (robot.base.twist().v - last) / kDt);
    last = robot.base.twist().v;
  }
  EXPECT_NEAR(fastest_gain, 0.5, 1e-9);
  EXPECT_NEAR(robot.pose.x, 0.5 * 2.0 - 0.5 * 0.5 * 0.5 / 0.5,
              0.02);  // v t - v^2 / 2a, less one driver cycle
  double start = robot.pose.x;
  robot.drive(0.0, 0.0, 1.0);
  EXPECT_NEAR(robot.pose.x - start, 0.5 * 0.5 / 2.0 / 1.0,
              0.011);  // v^2 / 2a, and at most two steps of delay
  EXPECT_EQ(robot.base.twist().v, 0.0);
}

TEST(KobukiBase, tooFastCommandsAreSlowedDownOnTheSameCurve) {
  FreeBase robot;
  robot.drive(2.0, 1.0, 2.0);
  EXPECT_NEAR(robot.base.twist().v, 0.7, 1e-9);
  EXPECT_NEAR(robot.base.twist().omega, 0.35, 1e-9);
  robot.drive(0.1, 10.0, 2.0);
  EXPECT_NEAR(robot.base.twist().omega, robot.base.params().max_vel_theta, 1e-9);
}

TEST(KobukiBase, commandTakesEffectAfterTheDelay) {
  KobukiParams params = KobukiParams::ideal();
  params.command_delay = 0.1;
  FreeBase robot(params);
  robot.base.commandVelocity(0.3, 0.0);
  robot.coast(0.10);
  EXPECT_EQ(robot.pose.x, 0.0);
  robot.coast(0.02);
  EXPECT_GT(robot.pose.x, 0.0);
}

TEST(KobukiBase, stopsBetween600And700MillisecondsAfterTheLastCommand) {
  for (int phase = 0; phase < 10; ++phase) {
    KobukiParams params = KobukiParams::ideal();
    params.wheel_deceleration = 1000.0;
    FreeBase robot(params);
    robot.drive(0.2, 0.0, 1.0 + phase * kDt);  // the watchdog's phase shifts against the last command
    double stopped_after = 0.0;
    while (robot.base.twist().v > 0.0 && stopped_after < 2.0) {
      robot.step();
      stopped_after += kDt;
    }
    EXPECT_GE(stopped_after, 0.6 - 1e-9) << phase;
    EXPECT_LE(stopped_after, 0.7 + 0.03) << phase;  // and the driver's cycle
    EXPECT_EQ(robot.base.timeoutCount(), 1U);
    EXPECT_TRUE(robot.base.timedOut());
    robot.coast(1.0);
    EXPECT_EQ(robot.base.timeoutCount(), 1U);  // one event
  }
}

TEST(KobukiBase, whoWasToldToStandIsNotStoppedByATimeout) {
  FreeBase robot;
  robot.drive(0.3, 0.0, 1.0);
  robot.drive(0.0, 0.0, 1.0);
  robot.coast(3.0);
  EXPECT_EQ(robot.base.timeoutCount(), 0U);
}

TEST(KobukiBase, doesNotTimeOutBeforeTheFirstCommand) {
  FreeBase robot;
  robot.coast(3.0);
  EXPECT_EQ(robot.base.timeoutCount(), 0U);
}

TEST(KobukiBase, ignoresCommandsWithoutMotorPower) {
  FreeBase robot;
  robot.drive(0.3, 0.0, 1.0);
  robot.base.setMotorPower(false);
  robot.drive(0.3, 0.0, 1.0);
  EXPECT_EQ(robot.base.twist().v, 0.0);
  EXPECT_EQ(robot.base.timeoutCount(), 0U);
  robot.base.setMotorPower(true);
  robot.coast(0.3);
  EXPECT_EQ(robot.base.twist().v, 0.0);  // the command from before is forgotten
  robot.drive(0.3, 0.0, 1.0);
  EXPECT_NEAR(robot.base.twist().v, 0.3, 1e-9);
}

TEST(KobukiBase, standsStillOnACommandThatIsNotFinite) {
  FreeBase robot;
  robot.drive(0.3, 0.0, 1.0);
  EXPECT_FALSE(robot.base.commandVelocity(std::numeric_limits<double>::quiet_NaN(), 0.0));
  robot.coast(0.5);
  EXPECT_EQ(robot.base.twist().v, 0.0);
  EXPECT_TRUE(std::isfinite(robot.pose.x));
  EXPECT_FALSE(robot.base.commandVelocity(0.1, std::numeric_limits<double>::infinity()));
}

TEST(KobukiBase, rejectsBadParameters) {
  KobukiParams params;
  params.wheel_separation = -1.0;
  EXPECT_THROW(KobukiBase(params, kDt, 1), std::invalid_argument);
  EXPECT_THROW(KobukiBase(KobukiParams(), 0.0, 1), std::invalid_argument);
  params = KobukiParams();
  params.battery_empty = 20.0;
  EXPECT_THROW(KobukiBase(params, kDt, 1), std::invalid_argument);
}

TEST(KobukiParams, shippedYamlHasEveryFieldAndTheDefaults) {
  const YAML::Node yaml = YAML::LoadFile("config/kobuki_base.yaml");
  const auto names = sarn::fieldNames<KobukiParams>();
  EXPECT_EQ(yaml.size(), names.size());
  KobukiParams params;
  EXPECT_TRUE(sarn::setFromYaml(yaml, params).empty());
  for (const std::string& name : names) {
    KobukiParams without = KobukiParams::ideal();
    YAML::Node one;
    ASSERT_TRUE(yaml[name]) << name;
    one[name] = yaml[name];
    EXPECT_TRUE(sarn::setFromYaml(one, without).empty()) << name;
  }
  const KobukiParams defaults;
  EXPECT_EQ(params.wheel_separation, defaults.wheel_separation);
  EXPECT_EQ(params.ticks_per_metre, defaults.ticks_per_metre);
  EXPECT_EQ(params.gyro_noise, defaults.gyro_noise);
  EXPECT_EQ(params.over_current, defaults.over_current);
}

// --- Commands as the driver sends them
// -----------------------------------------------------------------------------

TEST(BaseCommand, straightSpinAndArcFollowTheDriversFormulas) {
  const double b = 0.23;
  EXPECT_EQ(encodeCommand({0.1239, 0.0}, b).speed, 123);  // cut off, not rounded
  EXPECT_EQ(encodeCommand({-0.1239, 0.00009}, b).speed, -123);
  EXPECT_EQ(encodeCommand({0.1, 0.0}, b).radius, 0);
  EXPECT_EQ(encodeCommand({0.0, 1.0}, b).speed, 115);  // b / 2 * omega
  EXPECT_EQ(encodeCommand({0.0, -1.0}, b).speed, -115);
  EXPECT_EQ(encodeCommand({0.0, 1.0}, b).radius, 1);
  EXPECT_EQ(encodeCommand({0.0005, 1.0}, b).radius, 1);  // a circle of less than 1 mm is a spin
  EXPECT_EQ(encodeCommand({0.3, 0.5}, b).radius, 600);
  EXPECT_EQ(encodeCommand({0.3, 0.5}, b).speed, 357);  // (600 + 115) * 0.5
  EXPECT_EQ(encodeCommand({0.3, -0.5}, b).radius, -600);
  EXPECT_EQ(encodeCommand({0.3, -0.5}, b).speed, 357);  // (-600 - 115) * -0.5
  EXPECT_EQ(encodeCommand({0.5, 1e-3}, b).radius, std::numeric_limits<std::int16_t>::max());
}

TEST(BaseCommand, decodedTwistIsNearTheCommand) {
  for (double v = -0.5; v <= 0.5; v += 0.05) {
    for (double omega = -2.0; omega <= 2.0; omega += 0.1) {
      const sarn::Twist2D twist = decodeCommand(encodeCommand({v, omega}, 0.23), 0.23);
      EXPECT_NEAR(twist.v, v, 0.013) << v << " " << omega;
      EXPECT_NEAR(twist.omega, omega, 0.02) << v << " " << omega;
    }
  }
}

TEST(KobukiBase, quantisesCommandsOnlyWhenAsked) {
  KobukiParams params = KobukiParams::ideal();
  FreeBase exact(params);
  params.quantise_commands = true;
  FreeBase quantised(params);
  exact.drive(0.1239, 0.0, 1.0);
  quantised.drive(0.1239, 0.0, 1.0);
  EXPECT_NEAR(exact.base.twist().v, 0.1239, 1e-12);
  EXPECT_NEAR(quantised.base.twist().v, 0.123, 1e-12);
}

// --- Odometry
// ----------------------------------------------------------------------------------------------------------

TEST(KobukiBase, odometryOfAnIdealBaseFollowsTheTruth) {
  FreeBase robot;
  robot.drive(0.3, 0.4, 10.0);
  const sarn::Pose2D& odom = robot.base.odometry().pose();
  EXPECT_NEAR(odom.x, robot.pose.x, 2e-3);
  EXPECT_NEAR(odom.y, robot.pose.y, 2e-3);
  EXPECT_NEAR(odom.theta, robot.pose.theta, 0.011 * kDegree);  // the gyro's resolution
  EXPECT_NEAR(robot.base.odometry().velocityX(), 0.3, 0.01);   // whole ticks
  EXPECT_NEAR(robot.base.odometry().yawRate(), 0.4, 0.01 * kDegree);
  EXPECT_NE(robot.base.odometry().velocityY(), 0.0);  // the arc's sideways part
  EXPECT_LT(std::abs(robot.base.odometry().velocityY()), 0.01);
}

TEST(KobukiBase, odometryDriftsWithTheWayAndTheSeed) {
  KobukiParams params;
  double worst = 0.0;
  sarn::Pose2D first;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    FreeBase robot(params, seed);
    for (int lap = 0; lap < 10; ++lap) {
      robot.drive(0.5, 0.0, 4.0);
      robot.drive(0.0, 1.0, 1.5);
    }
    const sarn::Pose2D& odom = robot.base.odometry().pose();
    const double error = (odom.position() - robot.pose.position()).norm();
    EXPECT_GT(error, 1e-3) << seed;
    EXPECT_LT(error, 1.0) << seed;  // 20 m driven
    worst = std::max(worst, error);
    if (seed == 1) first = odom;
    if (seed == 2) {
      EXPECT_NE(first.x, odom.x);
    }
  }
  EXPECT_GT(worst, 0.01);
}

TEST(KobukiBase, odometryHeadingComesFromTheGyroNotFromTheWheels) {
  KobukiParams params = KobukiParams::ideal();
  FreeBase robot(params);
  // The floor turns the robot while its wheels stand.
  for (int i = 0; i < 100; ++i) {
    (void)robot.base.drive();
    robot.base.settle({0.0, 0.5}, false, 0);
  }
  // Zeroed at the first packet, after two of the 100 steps.
  EXPECT_NEAR(robot.base.odometry().pose().theta, 0.5 * 0.98, 0.02 * kDegree);
}

TEST(KobukiBase, resetOdometryMakesPoseAndHeadingZero) {
  FreeBase robot;
  robot.drive(0.3, 0.7, 3.0);
  EXPECT_GT(robot.base.odometry().wheelAngles()[0], 0.0);
  robot.base.resetOdometry();
  EXPECT_EQ(robot.base.odometry().pose().x, 0.0);
  EXPECT_EQ(robot.base.odometry().pose().theta, 0.0);
  EXPECT_EQ(robot.base.odometry().wheelAngles()[0], 0.0);
  robot.drive(0.3, 0.0, 3.0);
  EXPECT_GT(robot.base.odometry().pose().x, 0.5);
  EXPECT_LT(std::abs(robot.base.odometry().pose().theta),
            0.2);  // from the new zero: the rest of the old turn
}

TEST(DriverOdometry, countsAcrossTheWrapOfTheEncoders) {
  DriverOdometry odometry(0.23, 0.035, 11724.41658);
  SensorPacket packet;
  packet.left_encoder = packet.right_encoder = 65500;
  odometry.update(packet, 0.02);
  packet.left_encoder = packet.right_encoder = 100;
  odometry.update(packet, 0.02);
  EXPECT_NEAR(odometry.pose().x, 136 / 11724.41658, 1e-12);
  packet.left_encoder = packet.right_encoder = 65500;
  odometry.update(packet, 0.02);
  EXPECT_NEAR(odometry.pose().x, 0.0, 1e-12);
}

TEST(DriverOdometry, wrapsTheGyroAcrossHalfATurn) {
  DriverOdometry odometry(0.23, 0.035, 11724.41658);
  SensorPacket packet;
  packet.angle = 17900;
  odometry.update(packet, 0.02);
  EXPECT_EQ(odometry.pose().theta, 0.0);
  packet.angle = -17900;
  odometry.update(packet, 0.02);
  EXPECT_NEAR(odometry.pose().theta, 2.0 * kDegree, 1e-12);
}

TEST(DriverOdometry, wheelAnglesFollowTheWheels) {
  FreeBase robot;
  robot.drive(0.3, 0.0, 5.0);
  EXPECT_NEAR(robot.base.odometry().wheelAngles()[0], robot.pose.x / 0.035, 0.1);
  EXPECT_NEAR(robot.base.odometry().wheelRates()[1], 0.3 / 0.035, 0.2);
}

// --- Sensors
// -------------------------------------------------------------------------------------------------------------

TEST(KobukiBase, sendsAPacketEvery20Milliseconds) {
  FreeBase robot;
  robot.coast(1.0);
  EXPECT_EQ(robot.base.packetCount(), 50U);
  EXPECT_NEAR(robot.base.packet().time, 1.0, 1e-12);
  EXPECT_EQ(robot.base.packet().time_stamp, 1000);
  EXPECT_EQ(robot.base.packet().raw_rates.size(), 2U);
}

TEST(KobukiBase, encodersCount11724TicksAMetre) {
  KobukiParams params = KobukiParams::ideal();
  params.wheel_acceleration = params.wheel_deceleration = 1000.0;
  FreeBase robot(params);
  robot.drive(0.5, 0.0, 4.0);
  const auto expected = static_cast<std::uint16_t>(static_cast<std::int64_t>(robot.pose.x * 11724.41658));
  EXPECT_NEAR(robot.base.packet().left_encoder, expected, 1.0);
}

TEST(KobukiBase, heldWheelsTurnByTheirSlipOnly) {
  KobukiParams params = KobukiParams::ideal();
  params.blocked_wheel_slip = 0.0;
  FreeBase stalled(params);
  for (int i = 0; i < 200; ++i) {
    stalled.base.commandVelocity(0.3, 0.0);
    (void)stalled.base.drive();
    stalled.base.settle({0.0, 0.0}, true, kCentreBit);
  }
  EXPECT_EQ(stalled.base.packet().left_encoder, 0);
  EXPECT_EQ(stalled.base.packet().bumper, kCentreBit);
  EXPECT_GT(stalled.base.packet().current[0], 30);  // [10 mA] motors push
  params.blocked_wheel_slip = 1.0;
  FreeBase spinning(params);
  for (int i = 0; i < 200; ++i) {
    spinning.base.commandVelocity(0.3, 0.0);
    (void)spinning.base.drive();
    spinning.base.settle({0.0, 0.0}, true, 0);
  }
  EXPECT_GT(spinning.base.odometry().pose().x, 0.5);  // the driver is deceived
}

TEST(KobukiBase, gyroBiasWalksAndIsSeenInTheHeading) {
  KobukiParams params = KobukiParams::ideal();
  params.gyro_bias_sigma = 0.01;
  FreeBase robot(params, 3);
  robot.coast(10.0);
  EXPECT_GT(std::abs(robot.base.odometry().pose().theta), 1e-3);
  EXPECT_EQ(robot.pose.theta, 0.0);
}

TEST(Gyro, whiteNoiseHasItsDensity) {
  Gyro gyro({5e-4, 0.0, 0.0, 0.0}, 1);
  double squares = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double rate = gyro.measure(0.0, kDt);
    squares += rate * rate;
  }
  EXPECT_NEAR(std::sqrt(squares / n), 5e-4 / std::sqrt(kDt), 1e-4);
}

TEST(KobukiBase, reportsInjectedEvents) {
  FreeBase robot;
  robot.base.setCliff(kLeftBit);
  robot.base.setWheelDrop(kRightWheelDropBit);
  robot.base.setButtons(2);
  robot.coast(0.02);
  const SensorPacket& packet = robot.base.packet();
  EXPECT_EQ(packet.cliff, kLeftBit);
  EXPECT_EQ(packet.wheel_drop, kRightWheelDropBit);
  EXPECT_EQ(packet.buttons, 2);
  EXPECT_LT(packet.bottom[2], packet.bottom[0]);  // right, centre, left
  robot.base.setCliff(0);
  robot.coast(0.02);
  EXPECT_EQ(robot.base.packet().cliff, 0);
  EXPECT_EQ(robot.base.packet().bottom[2], robot.base.packet().bottom[0]);
}

TEST(KobukiBase, batteryFallsWithUse) {
  FreeBase idle;
  FreeBase driving;
  EXPECT_GT(idle.base.batteryVoltage(), 15.0);
  const double full = idle.base.batteryVoltage();
  idle.coast(60.0);
  driving.drive(0.7, 0.0, 60.0);
  EXPECT_LT(idle.base.batteryVoltage(), full);
  EXPECT_LT(driving.base.batteryVoltage(), idle.base.batteryVoltage());
  idle.base.setBatteryCharge(0.0);
  idle.coast(0.02);
  EXPECT_LE(idle.base.packet().battery, 132);
}

TEST(BumperBit, sectorsAreWrapped) {
  EXPECT_EQ(bumperBit(0.0), kCentreBit);
  EXPECT_EQ(bumperBit(29.0 * kDegree), kCentreBit);
  EXPECT_EQ(bumperBit(31.0 * kDegree), kLeftBit);
  EXPECT_EQ(bumperBit(89.0 * kDegree), kLeftBit);
  EXPECT_FALSE(bumperBit(91.0 * kDegree));
  EXPECT_EQ(bumperBit(-29.0 * kDegree), kCentreBit);
  EXPECT_EQ(bumperBit(-31.0 * kDegree), kRightBit);
  EXPECT_EQ(bumperBit(-89.0 * kDegree), kRightBit);
  EXPECT_FALSE(bumperBit(-91.0 * kDegree));
  EXPECT_FALSE(bumperBit(180.0 * kDegree));
  EXPECT_EQ(bumperBit((360.0 + 45.0) * kDegree), kLeftBit);
  EXPECT_EQ(bumperBit((-360.0 - 45.0) * kDegree), kRightBit);
  EXPECT_EQ(bumperBit(315.0 * kDegree), kRightBit);
}

}  // namespace
}  // namespace kobuki_sim
