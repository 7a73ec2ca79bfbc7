// SPDX-License-Identifier: BSD-3-Clause
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Time.h>

#include <cmath>
#include <vector>

#include "sarn_common_ros/call_service.h"
#include "wait_for.h"

namespace sarn_perception {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;

/// A flat wall at a depth [mm].
sensor_msgs::Image wall(double stamp, std::uint16_t millimetres) {
  sensor_msgs::Image image;
  image.header.stamp = ros::Time(stamp);
  image.header.frame_id = "camera_depth_optical_frame";
  image.width = kWidth;
  image.height = kHeight;
  image.encoding = "16UC1";
  image.step = 2 * kWidth;
  image.data.resize(2U * kWidth * kHeight);
  for (std::size_t i = 0; i < image.data.size(); i += 2) {
    image.data[i] = static_cast<std::uint8_t>(millimetres & 0xFF);
    image.data[i + 1] = static_cast<std::uint8_t>(millimetres >> 8);
  }
  return image;
}

sensor_msgs::CameraInfo xtion(double stamp) {
  sensor_msgs::CameraInfo info;
  info.header.stamp = ros::Time(stamp);
  info.width = kWidth;
  info.height = kHeight;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {570.3422, 0.0, 314.5, 0.0, 570.3422, 235.5, 0.0, 0.0, 1.0};
  info.P = {570.3422, 0.0, 314.5, 0.0, 0.0, 570.3422, 235.5, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

class DepthToScanNodeTest : public ::testing::Test {
 protected:
  DepthToScanNodeTest() {
    images_ = nh_.advertise<sensor_msgs::Image>("camera/depth/image_raw", 20);
    infos_ = nh_.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 20);
    lockstep_ = nh_.subscribe<std_msgs::Time>(
        "/lockstep/depthimage_to_laserscan", 50,
        [this](const std_msgs::TimeConstPtr& time) { done_.push_back(time->data.toSec()); });
  }

  void listen() {
    scans_ = nh_.subscribe<sensor_msgs::LaserScan>(
        "scan", 50, [this](const sensor_msgs::LaserScanConstPtr& scan) { received_.push_back(*scan); });
    ASSERT_TRUE(waitFor([this] {
      return images_.getNumSubscribers() == 1 && infos_.getNumSubscribers() == 1 &&
             lockstep_.getNumPublishers() == 1;
    })) << "the node subscribes once somebody listens to the scan";
  }

  void send(double stamp, std::uint16_t millimetres) {
    infos_.publish(xtion(stamp));
    images_.publish(wall(stamp, millimetres));
  }

  ros::NodeHandle nh_;
  ros::Publisher images_, infos_;
  ros::Subscriber scans_, lockstep_;
  std::vector<sensor_msgs::LaserScan> received_;
  std::vector<double> done_;
};

TEST_F(DepthToScanNodeTest, subscribesOnlyWhileSomebodyListens) {
  // The node is up once it has published its lockstep topic.
  ASSERT_TRUE(waitFor([this] { return lockstep_.getNumPublishers() == 1; }));
  EXPECT_EQ(images_.getNumSubscribers(), 0U);
  listen();
  scans_.shutdown();
  EXPECT_TRUE(waitFor([this] { return images_.getNumSubscribers() == 0; }));
}

TEST_F(DepthToScanNodeTest, turnsTenImagesIntoTenScansAndAcknowledgesEach) {
  listen();
  for (int i = 1; i <= 10; ++i) {
    send(i, 2000);
    ASSERT_TRUE(waitFor([&] { return received_.size() == static_cast<std::size_t>(i); }));
  }
  ASSERT_TRUE(waitFor([this] { return done_.size() == 10; }));
  EXPECT_EQ(done_.front(), 1.0);
  EXPECT_EQ(done_.back(), 10.0);
  const sensor_msgs::LaserScan& scan = received_.back();
  EXPECT_EQ(scan.header.stamp, ros::Time(10.0));
  EXPECT_EQ(scan.header.frame_id, "camera_depth_frame");
  EXPECT_EQ(scan.ranges.size(), kWidth);
  EXPECT_FLOAT_EQ(scan.scan_time, 0.033F);
  EXPECT_FLOAT_EQ(scan.time_increment, 0.0F);
  const auto ahead = static_cast<std::size_t>(std::lround(-scan.angle_min / scan.angle_increment));
  EXPECT_NEAR(scan.ranges[ahead + 2], 2.0F, 1e-3F);
}

TEST_F(DepthToScanNodeTest, acknowledgesAnImageItRefusesAndGoesOn) {
  listen();
  infos_.publish(xtion(1.0));
  sensor_msgs::Image color = wall(1.0, 2000);
  color.encoding = "rgb8";
  images_.publish(color);
  ASSERT_TRUE(waitFor([this] { return done_.size() == 1; }));
  send(2.0, 2000);
  ASSERT_TRUE(waitFor([this] { return received_.size() == 1; }));
  EXPECT_EQ(received_[0].header.stamp, ros::Time(2.0));
}

TEST_F(DepthToScanNodeTest, isReconfiguredLive) {
  listen();
  dynamic_reconfigure::Reconfigure call;
  call.request.config.doubles.resize(1);
  call.request.config.doubles[0].name = "range_max";
  call.request.config.doubles[0].value = 3.0;
  ASSERT_TRUE(ros::service::waitForService("/depthimage_to_laserscan/set_parameters", 20000));
  ASSERT_TRUE(sarn::callService("/depthimage_to_laserscan/set_parameters", call));
  send(1.0, 4000);
  ASSERT_TRUE(waitFor([this] { return received_.size() == 1; }));
  EXPECT_FLOAT_EQ(received_[0].range_max, 3.0F);
  EXPECT_EQ(received_[0].ranges[300], std::numeric_limits<float>::infinity()) << "shipped policy: inf";
  // Refused: the limits would cross. The old ones stay.
  call.request.config.doubles[0].value = 0.1;
  ASSERT_TRUE(sarn::callService("/depthimage_to_laserscan/set_parameters", call));
  send(2.0, 2000);
  ASSERT_TRUE(waitFor([this] { return received_.size() == 2; }));
  EXPECT_FLOAT_EQ(received_[1].range_max, 3.0F);
}

}  // namespace
}  // namespace sarn_perception

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "depthimage_to_laserscan_rostest");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
