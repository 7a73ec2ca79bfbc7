// SPDX-License-Identifier: BSD-3-Clause
// Wire compatibility: the MD5 sums of the public kobuki_msgs.
#include <gtest/gtest.h>
#include <kobuki_msgs/AutoDockingFeedback.h>
#include <kobuki_msgs/AutoDockingGoal.h>
#include <kobuki_msgs/AutoDockingResult.h>
#include <kobuki_msgs/BumperEvent.h>
#include <kobuki_msgs/ButtonEvent.h>
#include <kobuki_msgs/CliffEvent.h>
#include <kobuki_msgs/ControllerInfo.h>
#include <kobuki_msgs/DigitalInputEvent.h>
#include <kobuki_msgs/DigitalOutput.h>
#include <kobuki_msgs/DockInfraRed.h>
#include <kobuki_msgs/ExternalPower.h>
#include <kobuki_msgs/KeyboardInput.h>
#include <kobuki_msgs/Led.h>
#include <kobuki_msgs/MotorPower.h>
#include <kobuki_msgs/PowerSystemEvent.h>
#include <kobuki_msgs/RobotStateEvent.h>
#include <kobuki_msgs/ScanAngle.h>
#include <kobuki_msgs/SensorState.h>
#include <kobuki_msgs/Sound.h>
#include <kobuki_msgs/VersionInfo.h>
#include <kobuki_msgs/WheelDropEvent.h>

namespace {

template <class Message>
const char* md5() {
  return ros::message_traits::MD5Sum<Message>::value();
}

TEST(Md5, BumperEvent) { EXPECT_STREQ(md5<kobuki_msgs::BumperEvent>(), "ffe360cd50f14f9251d9844083e72ac5"); }
TEST(Md5, ButtonEvent) { EXPECT_STREQ(md5<kobuki_msgs::ButtonEvent>(), "49eca512765dbdec759a79083ffcec8d"); }
TEST(Md5, CliffEvent) { EXPECT_STREQ(md5<kobuki_msgs::CliffEvent>(), "c5b106efbb1427a94f517c5e05f06295"); }
TEST(Md5, ControllerInfo) {
  EXPECT_STREQ(md5<kobuki_msgs::ControllerInfo>(), "46af38e72f0640f41ed22174d43a2550");
}
TEST(Md5, DigitalInputEvent) {
  EXPECT_STREQ(md5<kobuki_msgs::DigitalInputEvent>(), "93da823c8b121f8a3940ef3830c58e44");
}
TEST(Md5, DigitalOutput) {
  EXPECT_STREQ(md5<kobuki_msgs::DigitalOutput>(), "1e97cd7f196a0270516b506e8bf29ca2");
}
TEST(Md5, DockInfraRed) {
  EXPECT_STREQ(md5<kobuki_msgs::DockInfraRed>(), "a3d77f7d15e50579473dcc24e9b97b34");
}
TEST(Md5, ExternalPower) {
  EXPECT_STREQ(md5<kobuki_msgs::ExternalPower>(), "95149d524971a4c6d19e64c827307194");
}
TEST(Md5, KeyboardInput) {
  EXPECT_STREQ(md5<kobuki_msgs::KeyboardInput>(), "9288b95cb32b48719d84d696be253401");
}
TEST(Md5, Led) { EXPECT_STREQ(md5<kobuki_msgs::Led>(), "4391183b0cf05f8f25d04220401b9f43"); }
TEST(Md5, MotorPower) { EXPECT_STREQ(md5<kobuki_msgs::MotorPower>(), "8f77c0161e0f2021493136bb5f3f0e51"); }
TEST(Md5, PowerSystemEvent) {
  EXPECT_STREQ(md5<kobuki_msgs::PowerSystemEvent>(), "f6464657d6c911b00c7bc7b43a154bf8");
}
TEST(Md5, RobotStateEvent) {
  EXPECT_STREQ(md5<kobuki_msgs::RobotStateEvent>(), "c6eccd4cb1f95df95635b56d6226ea32");
}
TEST(Md5, ScanAngle) { EXPECT_STREQ(md5<kobuki_msgs::ScanAngle>(), "06e2c839dc5c7f5c13ac09a8b4ff0a6a"); }
TEST(Md5, SensorState) { EXPECT_STREQ(md5<kobuki_msgs::SensorState>(), "430a4bfd78449c8740bfef32b26613a6"); }
TEST(Md5, Sound) { EXPECT_STREQ(md5<kobuki_msgs::Sound>(), "dfeab0daae67749c426c1db741a4f420"); }
TEST(Md5, VersionInfo) { EXPECT_STREQ(md5<kobuki_msgs::VersionInfo>(), "3dc0ce6edd49be1fc86730f4a4a21861"); }
TEST(Md5, WheelDropEvent) {
  EXPECT_STREQ(md5<kobuki_msgs::WheelDropEvent>(), "e102837d89384d67669a0df86b63f33b");
}

// AutoDocking.action: the sums of an empty goal, "string text", and "string state\nstring text".
TEST(Md5, AutoDockingGoal) {
  EXPECT_STREQ(md5<kobuki_msgs::AutoDockingGoal>(), "d41d8cd98f00b204e9800998ecf8427e");
}
TEST(Md5, AutoDockingResult) {
  EXPECT_STREQ(md5<kobuki_msgs::AutoDockingResult>(), "74697ed3d931f6eede8bf3a8dfeca160");
}
TEST(Md5, AutoDockingFeedback) {
  EXPECT_STREQ(md5<kobuki_msgs::AutoDockingFeedback>(), "03343b6aa0067ce6251bcc08bf318388");
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
