// SPDX-License-Identifier: BSD-3-Clause
// The node localization in a world of this test.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <std_srvs/Empty.h>

#include <limits>

#include "sarn_common_ros/call_service.h"
#include "scan_node_fixture.h"

namespace sarn_localization {
namespace {

class LocalizationNodeTest : public ScanNodeTest {
 protected:
  LocalizationNodeTest() : ScanNodeTest("localization") {}

  void SetUp() override {
    map_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    initial_pose_ = nh_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
    ScanNodeTest::SetUp();
    map_.publish(sarn::toMessage(unevenRoom(), "map"));
    ASSERT_TRUE(await([this] { return initial_pose_.getNumSubscribers() > 0; }));
  }

  void giveInitialPose(const sarn::Pose2D& pose, const std::string& frame = "map") {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header.frame_id = frame;
    message.pose.pose = sarn::toMessage(pose);
    message.pose.covariance[0] = message.pose.covariance[7] = 0.02;
    message.pose.covariance[35] = 0.01;
    initial_pose_.publish(message);
  }
  void startAt(const sarn::Pose2D& pose) {
    tick(1.0);
    publishOdometry(now_);
    // Again until it is heard: the node may not know the transforms of the first one's time yet.
    ASSERT_TRUE(await([&] {
      if (!map_from_odom_) giveInitialPose(pose);
      move();
      scan_.publish(scanNow());
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
      return map_from_odom_.has_value();
    }));
  }

  ros::Publisher map_, initial_pose_;
};

TEST_F(LocalizationNodeTest, findsAndKeepsThePose) {
  startAt(truth_);
  for (int i = 0; i < 150; ++i) {
    drive();
    if (i > 50) {
      ASSERT_LT(error(), 0.15) << "after " << i << " scans";
    }
  }
  ASSERT_TRUE(await([this] { return map_from_odom_->header.stamp >= now_ + ros::Duration(0.19); }))
      << "the newest odometry can be looked up in map";
  EXPECT_EQ(map_from_odom_->header.frame_id, "map");
  const auto pose = ros::topic::waitForMessage<geometry_msgs::PoseWithCovarianceStamped>("amcl_pose");
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->header.frame_id, "map");
  EXPECT_GT(pose->pose.covariance[0], 0.0);
}

TEST_F(LocalizationNodeTest, findsThePoseByTheGlobalService) {
  startAt({1.0, 1.0, 2.0});
  std_srvs::Empty call;
  ASSERT_TRUE(sarn::callService("global_localization", call));
  for (int i = 0; i < 150; ++i) drive();
  EXPECT_LT(error(), 0.2);
}

TEST_F(LocalizationNodeTest, survivesBadInputWithALineEach) {
  startAt(truth_);
  for (int i = 0; i < 50; ++i) drive();

  tick(kStep);
  publishOdometry(now_);
  sensor_msgs::LaserScan old = scanNow();
  old.header.stamp -= ros::Duration(0.55);
  scan_.publish(old);
  EXPECT_TRUE(await([&] { return warnings("is not after the last one") > 0; }));

  sensor_msgs::LaserScan no_increment = scanNow();
  no_increment.angle_increment = 0.0F;
  scan_.publish(no_increment);
  EXPECT_TRUE(await([&] { return warnings("angle_increment") > 0; }));

  move();
  sensor_msgs::LaserScan nothing = scanNow();
  nothing.ranges.assign(nothing.ranges.size(), std::numeric_limits<float>::quiet_NaN());
  scan_.publish(nothing);
  move();
  sensor_msgs::LaserScan endless = scanNow();
  endless.ranges.assign(endless.ranges.size(), std::numeric_limits<float>::infinity());
  scan_.publish(endless);

  // Scans whose transform never comes push each other out of the queue.
  EXPECT_TRUE(await([&] {
    move();
    sensor_msgs::LaserScan foreign = scanNow();
    foreign.header.frame_id = "nowhere";
    scan_.publish(foreign);
    return warnings("'nowhere'") > 0;
  }));
  for (int i = 0; i < 12; ++i) {
    move();
    sensor_msgs::LaserScan future = scanNow();
    future.header.stamp += ros::Duration(60.0);
    scan_.publish(future);
  }

  giveInitialPose(truth_, "odom");
  EXPECT_TRUE(await([&] { return warnings("initialpose") > 0; }));
  giveInitialPose({std::nan(""), 0.0, 0.0});

  nav_msgs::OccupancyGrid broken = sarn::toMessage(unevenRoom(), "map");
  broken.data.pop_back();
  map_.publish(broken);
  EXPECT_TRUE(await([&] { return warnings("cannot be used") > 0; }));

  for (int i = 0; i < 50; ++i) drive(80);
  EXPECT_GT(warnings("80 beams"), 0);
  EXPECT_LT(error(), 0.2) << "still knows where it is";

  map_.publish(sarn::toMessage(coarser(unevenRoom()), "map"));
  for (int i = 0; i < 50; ++i) drive();
  EXPECT_LT(error(), 0.3) << "in a map of another resolution too";
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "localization_rostest");
  const ros::NodeHandle nh;  // keeps the node alive
  return RUN_ALL_TESTS();
}
