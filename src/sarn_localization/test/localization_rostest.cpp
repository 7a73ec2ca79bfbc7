// SPDX-License-Identifier: BSD-3-Clause
// The node localization in a world of this test: clock, map, odometry and scans of a robot on a circle.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Time.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "drawn_map.h"
#include "sarn_common_ros/call_service.h"
#include "sarn_common_ros/conversions.h"

namespace sarn_localization {
namespace {

constexpr double kStep = 0.1;  // [s] between scans

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                          const sarn::Pose2D& pose, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform = sarn::toTransformMessage(pose);
  return message;
}

class LocalizationNodeTest : public testing::Test {
 protected:
  LocalizationNodeTest() : walls_(unevenRoom()) {}

  void SetUp() override {
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    map_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    scan_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
    initial_pose_ = nh_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
    transforms_ = nh_.subscribe("/tf", 100, &LocalizationNodeTest::onTransform, this);
    acknowledged_ = nh_.subscribe("lockstep/localization", 100, &LocalizationNodeTest::onAcknowledged, this);
    log_ = nh_.subscribe("/rosout", 100, &LocalizationNodeTest::onLog, this);
    static_.sendTransform(transform("base_footprint", "camera_depth_frame", kSensor, ros::Time()));
    nav_msgs::OccupancyGrid map = sarn::toMessage(unevenRoom(), "map");
    map_.publish(map);
    ASSERT_TRUE(await([this] {
      return scan_.getNumSubscribers() > 0 && initial_pose_.getNumSubscribers() > 0 &&
             acknowledged_.getNumPublishers() > 0 && transforms_.getNumPublishers() > 1;
    }));
  }

  void onTransform(const tf2_msgs::TFMessage& message) {
    for (const auto& t : message.transforms) {
      if (t.child_frame_id == "odom") map_from_odom_ = t;
    }
  }
  void onAcknowledged(const std_msgs::Time& message) { processed_ = std::max(processed_, message.data); }
  void onLog(const rosgraph_msgs::Log& message) {
    if (message.name == "/localization" && message.level >= rosgraph_msgs::Log::WARN)
      ++warnings_[message.msg];
  }
  /// Warnings so far that contain a text.
  int warnings(const std::string& text) const {
    int count = 0;
    for (const auto& [message, times] : warnings_) {
      if (message.find(text) != std::string::npos) count += times;
    }
    return count;
  }

  template <class Condition>
  static bool await(Condition condition) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(20.0);
    while (ros::ok() && ros::WallTime::now() < deadline) {
      if (condition()) return true;
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
    return condition();
  }

  void tick(double seconds) {
    now_ += ros::Duration(seconds);
    rosgraph_msgs::Clock clock;
    clock.clock = now_;
    clock_.publish(clock);
  }
  void publishOdometry(const ros::Time& stamp) {
    broadcaster_.sendTransform(transform("odom", "base_footprint", odometry_, stamp));
  }
  sensor_msgs::LaserScan scanNow(std::size_t beams = 160) const {
    const PlanarScan ideal = idealScan(walls_, truth_ * kSensor, 1.02, beams);
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = "camera_depth_frame";
    scan.header.stamp = now_;
    scan.angle_min = static_cast<float>(ideal.angle_min);
    scan.angle_increment = static_cast<float>(ideal.angle_increment);
    scan.range_min = 0.1F;
    scan.range_max = 20.0F;
    scan.ranges = ideal.ranges;
    return scan;
  }
  void move() {
    truth_ = sarn::advance(truth_, {0.5, 0.4}, kStep);
    odometry_ = sarn::advance(odometry_, {0.51, 0.403}, kStep);
    tick(kStep);
    publishOdometry(now_);
  }
  /// One step of the drive; until the node has done with its scan.
  void drive(std::size_t beams = 160) {
    move();
    scan_.publish(scanNow(beams));
    ASSERT_TRUE(await([this] { return processed_ >= now_; }));
  }
  void giveInitialPose(const sarn::Pose2D& pose, const std::string& frame = "map") {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header.frame_id = frame;
    message.pose.pose = sarn::toMessage(pose);
    message.pose.covariance[0] = message.pose.covariance[7] = 0.02;
    message.pose.covariance[35] = 0.01;
    initial_pose_.publish(message);
  }
  double error() const {
    const auto correction = sarn::fromMessage(map_from_odom_->transform);
    const sarn::Pose2D found = *correction * odometry_;
    return (found.position() - truth_.position()).norm() +
           std::abs(sarn::angleDifference(found.theta, truth_.theta));
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

  static constexpr sarn::Pose2D kSensor{-0.087, 0.0475, 0.0};
  WallDistance walls_;
  sarn::Pose2D truth_{4.0, 1.3, 0.0};
  sarn::Pose2D odometry_;
  ros::NodeHandle nh_;
  ros::Publisher clock_, map_, scan_, initial_pose_;
  ros::Subscriber transforms_, acknowledged_, log_;
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_;
  std::optional<geometry_msgs::TransformStamped> map_from_odom_;
  static inline ros::Time now_{100.0};  // goes on from test to test, as the node lives on
  ros::Time processed_{0.0};
  std::map<std::string, int> warnings_;
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
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "localization_rostest");
  const ros::NodeHandle nh;  // keeps the node alive
  return RUN_ALL_TESTS();
}
