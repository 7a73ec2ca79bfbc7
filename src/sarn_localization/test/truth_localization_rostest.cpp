// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <limits>
#include <optional>
#include <string>

#include "sarn_common/pose2d.h"
#include "sarn_common_ros/conversions.h"

namespace {

using sarn::Pose2D;

nav_msgs::Odometry odometry(double stamp, const Pose2D& pose, const std::string& frame) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(stamp);
  message.header.frame_id = frame;
  message.child_frame_id = "base_footprint";
  message.pose.pose = sarn::toMessage(pose);
  return message;
}

/// Publishes pairs and receives what truth_localization broadcasts.
class TruthLocalizationTest : public testing::Test {
 protected:
  void SetUp() override {
    truth_ = nh_.advertise<nav_msgs::Odometry>("/ground_truth/odom", 10);
    odometry_ = nh_.advertise<nav_msgs::Odometry>("/odom", 10);
    transforms_ = nh_.subscribe("/tf", 10, &TruthLocalizationTest::onTransform, this);
    ASSERT_TRUE(await([this] {
      return truth_.getNumSubscribers() > 0 && odometry_.getNumSubscribers() > 0 &&
             transforms_.getNumPublishers() > 0;
    }));
  }

  void onTransform(const tf2_msgs::TFMessage& message) { received_ = message.transforms.at(0); }

  template <class Condition>
  static bool await(Condition condition) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(20.0);
    while (ros::ok() && ros::WallTime::now() < deadline) {
      if (condition()) return true;
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    }
    return condition();
  }

  /// The transform after this pair of messages.
  std::optional<geometry_msgs::TransformStamped> transformAfter(double stamp, const Pose2D& robot_in_map,
                                                                const Pose2D& robot_in_odom) {
    received_.reset();
    truth_.publish(odometry(stamp, robot_in_map, "map"));
    odometry_.publish(odometry(stamp, robot_in_odom, "odom"));
    await([this] { return received_.has_value(); });
    return received_;
  }

  void expectTruthAfter(double stamp, const Pose2D& robot_in_map, const Pose2D& robot_in_odom) {
    const auto transform = transformAfter(stamp, robot_in_map, robot_in_odom);
    ASSERT_TRUE(transform) << "no transform for the pair at " << stamp;
    EXPECT_EQ(transform->header.frame_id, "map");
    EXPECT_EQ(transform->child_frame_id, "odom");
    EXPECT_EQ(transform->header.stamp, ros::Time(stamp));
    const auto map_from_odom = sarn::fromMessage(transform->transform);
    ASSERT_TRUE(map_from_odom);
    const Pose2D robot = *map_from_odom * robot_in_odom;
    EXPECT_NEAR(robot.x, robot_in_map.x, 1e-9);
    EXPECT_NEAR(robot.y, robot_in_map.y, 1e-9);
    EXPECT_NEAR(sarn::angleDifference(robot.theta, robot_in_map.theta), 0.0, 1e-9);
  }

  ros::NodeHandle nh_;
  ros::Publisher truth_;
  ros::Publisher odometry_;
  ros::Subscriber transforms_;
  std::optional<geometry_msgs::TransformStamped> received_;
};

TEST_F(TruthLocalizationTest, mapToBaseIsTheTruthThroughDriftResetAndClockJump) {
  expectTruthAfter(10.00, {1.0, 2.0, 0.5}, {0.0, 0.0, 0.0});
  expectTruthAfter(10.02, {1.5, 2.5, 0.6}, {0.52, 0.48, 0.11});
  expectTruthAfter(10.04, {1.6, 2.5, 0.7}, {0.0, 0.0, 0.0});   // odometry was reset
  expectTruthAfter(3.00, {-4.0, 0.0, -3.0}, {0.1, 0.0, 0.2});  // clock jumped back
  expectTruthAfter(3.02, {-4.1, 0.0, -3.1}, {0.2, 0.0, 0.1});
}

TEST_F(TruthLocalizationTest, ignoresNanAndForeignFrames) {
  expectTruthAfter(20.00, {1.0, 1.0, 1.0}, {0.5, 0.0, 0.0});
  received_.reset();
  Pose2D broken;
  broken.x = std::numeric_limits<double>::quiet_NaN();
  truth_.publish(odometry(20.02, broken, "map"));
  odometry_.publish(odometry(20.02, {}, "odom"));
  truth_.publish(odometry(20.04, {}, "map"));
  odometry_.publish(odometry(20.04, {}, "elsewhere"));
  // The next transform belongs to the next good pair, so neither bad pair made one.
  truth_.publish(odometry(20.06, {}, "map"));
  odometry_.publish(odometry(20.06, {}, "odom"));
  ASSERT_TRUE(await([this] { return received_.has_value(); }));
  EXPECT_EQ(received_->header.stamp, ros::Time(20.06));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "truth_localization_rostest");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
