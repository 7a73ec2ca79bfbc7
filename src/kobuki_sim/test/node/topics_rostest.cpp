// SPDX-License-Identifier: BSD-3-Clause
// Types, rates, latching and frames of the topics.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <kobuki_msgs/ControllerInfo.h>
#include <kobuki_msgs/RobotStateEvent.h>
#include <kobuki_msgs/SensorState.h>
#include <kobuki_msgs/VersionInfo.h>
#include <people_msgs/People.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim_fixture.h"

namespace kobuki_sim {
namespace {

using Topics = PausedSim;

template <class Message>
std::vector<double> stampDifferences(const std::vector<Message>& messages) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < messages.size(); ++i) {
    differences.push_back((messages[i].header.stamp - messages[i - 1].header.stamp).toSec());
  }
  return differences;
}

TEST_F(Topics, odometryJointStatesTruthAndTransformShareStampsAtFiftyHertz) {
  const Recorder<nav_msgs::Odometry> odometry("/odom");
  const Recorder<sensor_msgs::JointState> joints("/joint_states");
  const Recorder<tf2_msgs::TFMessage> transforms("/tf");
  ASSERT_TRUE(odometry.awaitConnection() && joints.awaitConnection() && transforms.awaitConnection());
  step(100);
  ASSERT_TRUE(odometry.awaitCount(50) && joints.awaitCount(50) && transforms.awaitCount(50));
  ASSERT_TRUE(truth_.awaitCount(50));
  EXPECT_EQ(odometry.messages.size(), 50U);
  for (const double difference : stampDifferences(odometry.messages)) EXPECT_NEAR(difference, 0.02, 1e-9);
  for (std::size_t i = 0; i < 50; ++i) {
    const auto& message = odometry.messages[i];
    EXPECT_EQ(message.header.frame_id, "odom");
    EXPECT_EQ(message.child_frame_id, "base_footprint");
    EXPECT_EQ(joints.messages[i].header.stamp, message.header.stamp);
    EXPECT_EQ(truth_.messages[i].header.stamp, message.header.stamp);
    const auto& transform = transforms.messages[i].transforms.at(0);
    EXPECT_EQ(transform.header.stamp, message.header.stamp);
    EXPECT_EQ(transform.header.frame_id, "odom");
    EXPECT_EQ(transform.child_frame_id, "base_footprint");
    EXPECT_EQ(transform.transform.translation.x, message.pose.pose.position.x);
  }
  EXPECT_EQ(truth_.messages[0].header.frame_id, "map");
  EXPECT_EQ(truth_.messages[0].child_frame_id, "base_footprint");
}

TEST_F(Topics, theClockTicksEveryStepAndNeverGoesBack) {
  const Recorder<rosgraph_msgs::Clock> clock("/clock");
  ASSERT_TRUE(clock.awaitConnection());
  const ros::Time end = step(50);
  ASSERT_TRUE(await([&] { return !clock.messages.empty() && clock.messages.back().clock == end; }));
  std::set<ros::Time> ticks;
  for (const auto& message : clock.messages) {
    EXPECT_TRUE(ticks.empty() || message.clock >= *ticks.rbegin());
    ticks.insert(message.clock);
  }
  EXPECT_GE(ticks.size(), 50U);
  EXPECT_EQ((end - *ticks.begin()).toNSec(), static_cast<std::int64_t>(ticks.size() - 1) * 10'000'000);
}

TEST_F(Topics, scansOfTheLidarComeAtItsFrequencyInItsFrame) {
  const Recorder<sensor_msgs::LaserScan> scans("/scan");
  ASSERT_TRUE(scans.awaitConnection());
  for (std::size_t i = 1; i <= 10; ++i) {  // one by one: the queue holds five
    step(10);
    ASSERT_TRUE(scans.awaitCount(i));
  }
  for (const double difference : stampDifferences(scans.messages)) EXPECT_NEAR(difference, 0.1, 1e-9);
  for (const auto& scan : scans.messages) {
    EXPECT_EQ(scan.header.frame_id, "base_laser_link");
    ASSERT_EQ(scan.ranges.size(), 720U);
    EXPECT_NEAR(scan.angle_min + 719.0F * scan.angle_increment, scan.angle_max, 1e-4F);
    EXPECT_NEAR(scan.scan_time, 0.1F, 1e-6F);
    EXPECT_EQ(scan.time_increment, 0.0F) << "all beams are of the stamp";
  }
}

TEST_F(Topics, coreStreamComesAtFiftyHertz) {
  const Recorder<kobuki_msgs::SensorState> core("/mobile_base/sensors/core");
  ASSERT_TRUE(core.awaitConnection());
  step(100);
  ASSERT_TRUE(core.awaitCount(50));
  for (const double difference : stampDifferences(core.messages)) EXPECT_NEAR(difference, 0.02, 1e-9);
  EXPECT_EQ(core.messages[0].bottom.size(), 3U);
  EXPECT_EQ(core.messages[0].current.size(), 2U);
  EXPECT_GT(core.messages[0].battery, 132);
  const int ticks = core.messages[1].time_stamp - core.messages[0].time_stamp;
  EXPECT_EQ(ticks, 20) << "[ms] of the base's own clock";
}

TEST_F(Topics, gyroComesAtFiftyHertzAndRawInBackDatedBursts) {
  const Recorder<sensor_msgs::Imu> imu("/mobile_base/sensors/imu_data");
  const Recorder<sensor_msgs::Imu> raw("/mobile_base/sensors/imu_data_raw");
  ASSERT_TRUE(imu.awaitConnection() && raw.awaitConnection());
  step(100);
  ASSERT_TRUE(imu.awaitCount(50) && raw.awaitCount(100));
  EXPECT_EQ(imu.messages[0].header.frame_id, "gyro_link");
  for (const double difference : stampDifferences(imu.messages)) EXPECT_NEAR(difference, 0.02, 1e-9);
  for (const double difference : stampDifferences(raw.messages)) EXPECT_NEAR(difference, 0.01, 1e-9);
  EXPECT_EQ(raw.messages[1].header.stamp, imu.messages[0].header.stamp);
}

TEST_F(Topics, whatIsLatchedReachesWhoComesLate) {
  const Recorder<kobuki_msgs::VersionInfo> version("/mobile_base/version_info");
  const Recorder<kobuki_msgs::ControllerInfo> controller("/mobile_base/controller_info");
  const Recorder<kobuki_msgs::RobotStateEvent> state("/mobile_base/events/robot_state");
  ASSERT_TRUE(version.awaitCount(1) && controller.awaitCount(1) && state.awaitCount(1));
  EXPECT_NE(version.messages[0].features & kobuki_msgs::VersionInfo::SMOOTH_MOVE_START, 0U);
  EXPECT_EQ(state.messages[0].state, kobuki_msgs::RobotStateEvent::ONLINE);
  EXPECT_EQ(controller.messages[0].type, kobuki_msgs::ControllerInfo::DEFAULT);
}

TEST_F(Topics, controllerGainsAreTakenUnlessNegative) {
  auto command = nh_.advertise<kobuki_msgs::ControllerInfo>("/mobile_base/commands/controller_info", 10);
  const Recorder<kobuki_msgs::ControllerInfo> controller("/mobile_base/controller_info");
  ASSERT_TRUE(controller.awaitCount(1));
  ASSERT_TRUE(await([&] { return command.getNumSubscribers() > 0; }));
  kobuki_msgs::ControllerInfo gains;
  gains.type = kobuki_msgs::ControllerInfo::USER_CONFIGURED;
  gains.p_gain = -1.0;
  command.publish(gains);
  gains.p_gain = 42.0;
  command.publish(gains);
  ASSERT_TRUE(controller.awaitCount(2));
  EXPECT_EQ(controller.messages[1].p_gain, 42.0) << "the negative gain was taken";
  gains.type = kobuki_msgs::ControllerInfo::DEFAULT;
  command.publish(gains);
  ASSERT_TRUE(controller.awaitCount(3));
  EXPECT_EQ(controller.messages[2].p_gain, 100.0);
}

TEST_F(Topics, diagnosticsComeOnceASecond) {
  const Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(diagnostics.awaitConnection());
  for (int second = 0; second < 4; ++second) {
    const std::size_t count = diagnostics.messages.size();
    step(100);
    ASSERT_TRUE(diagnostics.awaitCount(count + 1));
  }
  for (const double difference : stampDifferences(diagnostics.messages)) EXPECT_NEAR(difference, 1.0, 1e-9);
  EXPECT_EQ(diagnostics.messages[0].status.size(), 10U);
}

TEST_F(Topics, peopleComeAtTwentyHertzInMapWithTheirTags) {
  const Recorder<people_msgs::People> people("/ground_truth/people");
  ASSERT_TRUE(people.awaitConnection());
  step(200);
  ASSERT_TRUE(people.awaitCount(40));
  for (const double difference : stampDifferences(people.messages)) EXPECT_NEAR(difference, 0.05, 1e-9);
  const auto& message = people.messages.back();
  EXPECT_EQ(message.header.frame_id, "map");
  ASSERT_EQ(message.people.size(), 2U);
  EXPECT_EQ(message.people[0].name, "anna");
  EXPECT_EQ(message.people[0].tagnames, (std::vector<std::string>{"group", "radius", "model"}));
  EXPECT_EQ(message.people[0].tags[0], "friends");
  EXPECT_EQ(message.people[0].tags[2], "standing");
  EXPECT_EQ(std::stod(message.people[1].tags[1]), 0.3);
}

TEST_F(Topics, depthImageAndCameraInfoComeTogetherAtThirtyHertz) {
  const Recorder<sensor_msgs::Image> images("/camera/depth/image_raw");
  const Recorder<sensor_msgs::CameraInfo> info("/camera/depth/camera_info");
  ASSERT_TRUE(images.awaitConnection() && info.awaitConnection());
  // In portions, so that no queue overflows.
  for (int tenth = 1; tenth <= 10; ++tenth) {
    step(10);
    ASSERT_TRUE(images.awaitCount(static_cast<std::size_t>(3 * tenth - 1)));
  }
  ASSERT_TRUE(info.awaitCount(images.messages.size()));
  EXPECT_NEAR(static_cast<double>(images.messages.size()), 30.0, 1.0);
  for (const double difference : stampDifferences(images.messages)) {
    EXPECT_GE(difference, 0.03 - 1e-9);
    EXPECT_LE(difference, 0.04 + 1e-9);
  }
  for (std::size_t i = 0; i < images.messages.size(); ++i) {
    EXPECT_EQ(info.messages[i].header.stamp, images.messages[i].header.stamp);
    EXPECT_EQ(info.messages[i].header.frame_id, "camera_depth_optical_frame");
    EXPECT_EQ(images.messages[i].header.frame_id, "camera_depth_optical_frame");
  }
}

TEST_F(Topics, theDepthImageShowsTheWallAhead) {
  const Recorder<sensor_msgs::Image> images("/camera/depth/image_raw");
  ASSERT_TRUE(images.awaitConnection());
  step(5);
  ASSERT_TRUE(images.awaitCount(1));
  const auto& image = images.messages[0];
  ASSERT_EQ(image.width, 640U);
  ASSERT_EQ(image.height, 480U);
  ASSERT_EQ(image.encoding, "16UC1");
  std::vector<int> depths;  // [mm] along the row of the optical axis
  for (std::size_t u = 300; u < 330; ++u) {
    const std::size_t offset = 235 * image.step + 2 * u;
    const int depth = image.data[offset] + 256 * image.data[offset + 1];
    if (depth > 0) depths.push_back(depth);
  }
  ASSERT_GT(depths.size(), 15U);
  std::sort(depths.begin(), depths.end());
  const double expected = 5900.0 - (2500.0 - 87.0);  // [mm] wall minus camera
  EXPECT_NEAR(depths[depths.size() / 2], expected, 0.02 * expected);
}

}  // namespace
}  // namespace kobuki_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "topics_rostest");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
