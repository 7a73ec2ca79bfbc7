// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/velocity_smoother.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sarn_navigation {
namespace {

constexpr double kDt = 0.05;  // [s]

VelocitySmootherParams withFeedback(RobotFeedback feedback) {
  VelocitySmootherParams params;
  params.robot_feedback = static_cast<int>(feedback);
  return params;
}

/// Sends `input` and updates once a period for `periods` periods; returns the last output.
sarn::Twist2D drive(VelocitySmoother& smoother, const sarn::Twist2D& input, int periods, double& now) {
  sarn::Twist2D output;
  for (int i = 0; i < periods; ++i) {
    now += kDt;
    smoother.setInput(input, now);
    output = smoother.update(now).value();
  }
  return output;
}

TEST(ReachableChange, isTheFormulaOfAcceleration) {
  EXPECT_DOUBLE_EQ(reachableChange(0.0, 1.0, 1.0, 1.5, 0.1), 0.1);
  EXPECT_DOUBLE_EQ(reachableChange(0.5, 0.0, 1.0, 1.5, 0.1), -0.15);
  EXPECT_DOUBLE_EQ(reachableChange(-0.5, 0.0, 1.0, 1.5, 0.1), 0.15);
  EXPECT_DOUBLE_EQ(reachableChange(0.5, 0.45, 1.0, 1.5, 0.1), 0.45 - 0.5);
  // 0.05 s of braking from 0.075 to zero, then 0.05 s of acceleration
  EXPECT_NEAR(reachableChange(0.075, -1.0, 1.0, 1.5, 0.1), -0.125, 1e-12);
  EXPECT_DOUBLE_EQ(reachableChange(0.3, 0.3, 1.0, 1.5, 0.1), 0.0);
}

TEST(VelocitySmoother, saysNothingBeforeTheFirstInput) {
  VelocitySmoother smoother{VelocitySmootherParams{}};
  EXPECT_FALSE(smoother.update(1.0));
}

TEST(VelocitySmoother, acceleratesAtTheLimitUntilTheTarget) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 4, now).v, 0.2, 1e-12);
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 10, now).v, 0.5, 1e-12);
}

TEST(VelocitySmoother, deceleratesByTheFactorFaster) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  (void)drive(smoother, {0.6, 0.0}, 20, now);
  EXPECT_NEAR(drive(smoother, {0.0, 0.0}, 2, now).v, 0.6 - 2 * kDt * 1.5, 1e-12);
}

TEST(VelocitySmoother, clampsSpeedsOfBothSigns) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  EXPECT_DOUBLE_EQ(drive(smoother, {9.0, 0.0}, 100, now).v, 0.8);
  EXPECT_DOUBLE_EQ(drive(smoother, {-9.0, -90.0}, 200, now).v, -0.8);
  EXPECT_DOUBLE_EQ(drive(smoother, {-9.0, -90.0}, 1, now).omega, -5.4);
}

TEST(VelocitySmoother, keepsTheDirectionOfTheIncrement) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  const sarn::Twist2D output = drive(smoother, {0.1, 2.0}, 3, now);
  EXPECT_NEAR(output.v / output.omega, 0.1 / 2.0, 1e-12);
  EXPECT_NEAR(output.omega, 3 * kDt * 2.0, 1e-12);
}

TEST(VelocitySmoother, neverExceedsALimitForRandomInputs) {
  const VelocitySmootherParams params = withFeedback(RobotFeedback::kNone);
  VelocitySmoother smoother(params);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> speed(-2.0, 2.0);
  sarn::Twist2D last;
  double now = 10.0;
  for (int i = 0; i < 2000; ++i) {
    now += kDt;
    if (i % 7 == 0) smoother.setInput({speed(random), 4.0 * speed(random)}, now);
    const auto output = smoother.update(now);
    if (!output) continue;
    EXPECT_LE(std::abs(output->v), params.speed_lim_v);
    EXPECT_LE(std::abs(output->omega), params.speed_lim_w);
    EXPECT_LE(std::abs(output->v - last.v), params.accel_lim_v * params.decel_factor * kDt + 1e-9);
    EXPECT_LE(std::abs(output->omega - last.omega), params.accel_lim_w * params.decel_factor * kDt + 1e-9);
    const bool faster = std::abs(output->v) > std::abs(last.v) && output->v * last.v >= 0.0;
    if (faster) {
      EXPECT_LE(std::abs(output->v - last.v), params.accel_lim_v * kDt + 1e-9);
    }
    last = *output;
  }
}

TEST(VelocitySmoother, silenceRampsDownToZeroAndThenToSilence) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  (void)drive(smoother, {0.3, 0.0}, 20, now);
  EXPECT_NEAR(smoother.inputTimeout(), 3 * kDt, 1e-9);
  const double last_input = now;
  double last = 0.3;
  bool ended = false;
  while (now < last_input + 2.0) {
    now += kDt;
    const auto output = smoother.update(now);
    if (now - last_input < 3 * kDt - 1e-6) {
      EXPECT_DOUBLE_EQ(output.value().v, 0.3);
    }
    if (output) {
      EXPECT_FALSE(ended) << "spoke again at " << now;
      last = output->v;
    } else {
      ended = true;
    }
  }
  EXPECT_TRUE(ended);
  EXPECT_DOUBLE_EQ(last, 0.0);
}

TEST(VelocitySmoother, aSlowInputIsHeldForAtMostHalfASecond) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  for (int i = 0; i < 10; ++i) smoother.setInput({0.2, 0.0}, 10.0 + 0.4 * i);
  EXPECT_DOUBLE_EQ(smoother.inputTimeout(), 0.5);
}

TEST(VelocitySmoother, aZeroInputIsPublishedWhileItLasts) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 10.0;
  EXPECT_DOUBLE_EQ(drive(smoother, {0.0, 0.0}, 5, now).v, 0.0);
}

TEST(VelocitySmoother, restartsFromFeedbackThatIsFarAway) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kEndCommands));
  double now = 10.0;
  smoother.setFeedback({0.0, 0.0}, now);
  (void)drive(smoother, {0.5, 0.0}, 2, now);
  smoother.setFeedback({-0.4, 0.0}, now);  // somebody else backs up
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 1, now).v, -0.4 + 1.5 * kDt, 1e-12);
}

TEST(VelocitySmoother, ignoresFeedbackThatLagsByTwoPeriods) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kEndCommands));
  double now = 10.0;
  for (int i = 1; i <= 8; ++i) {
    smoother.setFeedback({std::max(0, i - 3) * kDt, 0.0}, now);
    EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 1, now).v, i * kDt, 1e-12);
  }
}

TEST(VelocitySmoother, resumesFromFeedbackAfterAPause) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kEndCommands));
  double now = 10.0;
  (void)drive(smoother, {0.5, 0.0}, 20, now);
  for (; now < 15.0; now += kDt) (void)smoother.update(now);
  smoother.setFeedback({0.1, 0.0}, now);
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 1, now).v, 0.1 + kDt, 1e-12);
}

TEST(VelocitySmoother, endCommandsThatStoppedMeanARobotThatStopped) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kEndCommands));
  double now = 10.0;
  smoother.setFeedback({0.7, 0.0}, now);
  now += 5.0;
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 1, now).v, kDt, 1e-12);
}

TEST(VelocitySmoother, aClockThatJumpsBackIsAFreshStart) {
  VelocitySmoother smoother(withFeedback(RobotFeedback::kNone));
  double now = 100.0;
  (void)drive(smoother, {0.5, 0.0}, 20, now);
  EXPECT_FALSE(smoother.update(1.0));
  now = 1.0;
  EXPECT_NEAR(drive(smoother, {0.5, 0.0}, 1, now).v, kDt, 1e-12);
}

}  // namespace
}  // namespace sarn_navigation
