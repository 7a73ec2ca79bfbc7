// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/safety_controller.h"

#include <gtest/gtest.h>

namespace sarn_navigation {
namespace {

void expectTwist(const std::optional<sarn::Twist2D>& twist, double v, double omega) {
  ASSERT_TRUE(twist);
  EXPECT_DOUBLE_EQ(twist->v, v);
  EXPECT_DOUBLE_EQ(twist->omega, omega);
}

TEST(SafetyController, isSilentWithoutAnEvent) {
  EXPECT_FALSE(SafetyController{SafetyControllerParams{}}.command(1.0));
}

TEST(SafetyController, backsAwayFromEachSide) {
  for (const bool cliff : {false, true}) {
    const auto commandFor = [&](Side side) {
      SafetyController controller{SafetyControllerParams{}};
      cliff ? controller.setCliff(side, true, 1.0) : controller.setBumper(side, true, 1.0);
      return controller.command(1.0);
    };
    expectTwist(commandFor(Side::kLeft), -0.1, -0.4);
    expectTwist(commandFor(Side::kCenter), -0.1, 0.0);
    expectTwist(commandFor(Side::kRight), -0.1, 0.4);
  }
}

TEST(SafetyController, backsStraightWhenTouchedOnBothSides) {
  SafetyController controller{SafetyControllerParams{}};
  controller.setBumper(Side::kLeft, true, 1.0);
  controller.setCliff(Side::kRight, true, 1.0);
  expectTwist(controller.command(1.0), -0.1, 0.0);
}

TEST(SafetyController, aDroppedWheelStopsWhateverElseHappens) {
  SafetyController controller{SafetyControllerParams{}};
  controller.setBumper(Side::kLeft, true, 1.0);
  controller.setWheelDrop(Wheel::kRight, true);
  expectTwist(controller.command(1.0), 0.0, 0.0);
  controller.setWheelDrop(Wheel::kRight, false);
  expectTwist(controller.command(1.0), -0.1, -0.4);
}

TEST(SafetyController, isSilentAfterTheRelease) {
  SafetyController controller{SafetyControllerParams{}};
  controller.setBumper(Side::kCenter, true, 1.0);
  controller.setBumper(Side::kCenter, false, 2.0);
  EXPECT_FALSE(controller.command(2.0));
}

TEST(SafetyController, extendsTheEventAfterItsRelease) {
  SafetyControllerParams params;
  params.time_to_extend_bump_cliff_events = 0.5;
  SafetyController controller(params);
  controller.setBumper(Side::kRight, true, 1.0);
  controller.setBumper(Side::kRight, false, 3.0);
  expectTwist(controller.command(3.49), -0.1, 0.4);
  EXPECT_FALSE(controller.command(3.5));
}

TEST(SafetyController, aReleaseWithoutAPressExtendsNothing) {
  SafetyControllerParams params;
  params.time_to_extend_bump_cliff_events = 0.5;
  SafetyController controller(params);
  controller.setCliff(Side::kRight, false, 3.0);
  EXPECT_FALSE(controller.command(3.1));
}

TEST(SafetyController, anExtensionEndsWhenTheClockJumpsBack) {
  SafetyControllerParams params;
  params.time_to_extend_bump_cliff_events = 5.0;
  SafetyController controller(params);
  controller.setBumper(Side::kLeft, true, 100.0);
  controller.setBumper(Side::kLeft, false, 101.0);
  EXPECT_FALSE(controller.command(2.0));
}

}  // namespace
}  // namespace sarn_navigation
