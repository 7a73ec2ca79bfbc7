// SPDX-License-Identifier: BSD-3-Clause
// The nodes of the velocity chain on real topics. Every wait is for a condition; the test's own time limit
// (in the .test file) is the only clock.
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <kobuki_msgs/BumperEvent.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/String.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace {

using geometry_msgs::Twist;

Twist twist(double v, double omega = 0.0) {
  Twist message;
  message.linear.x = v;
  message.angular.z = omega;
  return message;
}

class VelocityChain : public testing::Test {
 protected:
  /// Runs `each_round` at 50 Hz until `condition` holds or ROS is shut down.
  static bool await(const std::function<bool()>& condition, const std::function<void()>& each_round = [] {}) {
    ros::WallRate rate(50.0);
    while (ros::ok()) {
      each_round();
      ros::spinOnce();
      if (condition()) return true;
      rate.sleep();
    }
    return false;
  }

  ros::Publisher connectedPublisher(const std::string& topic) {
    ros::Publisher publisher = nh_.advertise<Twist>(topic, 10);
    EXPECT_TRUE(await([&] { return publisher.getNumSubscribers() > 0; })) << topic;
    return publisher;
  }

  ros::NodeHandle nh_;
};

class MuxTest : public VelocityChain {
 protected:
  MuxTest() {
    active_subscriber_ = nh_.subscribe<std_msgs::String>(
        "cmd_vel_mux/active", 10, [this](const std_msgs::StringConstPtr& m) { active_ = m->data; });
    output_subscriber_ = nh_.subscribe<Twist>(
        "cmd_vel_mux/output", 100, [this](const geometry_msgs::TwistConstPtr& m) { output_.push_back(*m); });
    EXPECT_TRUE(await([this] { return output_subscriber_.getNumPublishers() > 0 && active_ == "idle"; }));
  }
  std::string active_;
  std::vector<Twist> output_;
  ros::Subscriber active_subscriber_;
  ros::Subscriber output_subscriber_;
};

TEST_F(MuxTest, handsOverByPriorityAndReleasesWithoutAZero) {
  auto navi = connectedPublisher("cmd_vel_mux/input/navi");
  auto teleop = connectedPublisher("cmd_vel_mux/input/teleop");
  ASSERT_TRUE(await([this] { return active_ == "Navigation" && !output_.empty(); },
                    [&] { navi.publish(twist(0.5)); }));
  EXPECT_DOUBLE_EQ(output_.back().linear.x, 0.5);
  ASSERT_TRUE(await([this] { return active_ == "Teleoperation" && output_.back().linear.x == 0.2; },
                    [&] {
                      navi.publish(twist(0.5));
                      teleop.publish(twist(0.2));
                    }));
  output_.clear();
  ASSERT_TRUE(await([this] { return active_ == "Navigation"; }, [&] { navi.publish(twist(0.5)); }));
  ASSERT_TRUE(await([this] { return active_ == "idle"; }));
  for (const auto& sent : output_) EXPECT_NE(sent.linear.x, 0.0);
}

TEST_F(MuxTest, dropsATwistThatIsNotFinite) {
  auto teleop = connectedPublisher("cmd_vel_mux/input/teleop");
  ASSERT_TRUE(await([this] { return !output_.empty(); },
                    [&] {
                      teleop.publish(twist(std::numeric_limits<double>::quiet_NaN()));
                      teleop.publish(twist(0.1, std::numeric_limits<double>::infinity()));
                      teleop.publish(twist(0.3));
                    }));
  for (const auto& sent : output_) EXPECT_DOUBLE_EQ(sent.linear.x, 0.3);
  ASSERT_TRUE(await([this] { return active_ == "idle"; }));
}

TEST_F(VelocityChain, aBumpBacksTheRobotUpWhileItLasts) {
  std::vector<Twist> output;
  const auto subscriber =
      nh_.subscribe<Twist>("cmd_vel_mux/input/safety_controller", 100,
                           [&](const geometry_msgs::TwistConstPtr& m) { output.push_back(*m); });
  ros::Publisher events = nh_.advertise<kobuki_msgs::BumperEvent>("mobile_base/events/bumper", 10);
  ASSERT_TRUE(await([&] { return events.getNumSubscribers() > 0 && subscriber.getNumPublishers() > 0; }));
  EXPECT_TRUE(output.empty());
  kobuki_msgs::BumperEvent event;
  event.bumper = kobuki_msgs::BumperEvent::LEFT;
  event.state = kobuki_msgs::BumperEvent::PRESSED;
  events.publish(event);
  ASSERT_TRUE(await([&] { return output.size() >= 5; }));
  EXPECT_DOUBLE_EQ(output.back().linear.x, -0.1);
  EXPECT_DOUBLE_EQ(output.back().angular.z, -0.4);
  event.state = kobuki_msgs::BumperEvent::RELEASED;
  events.publish(event);
  // Pressing the other side proves that the release was heard: the first command after it is the other one.
  event.bumper = kobuki_msgs::BumperEvent::RIGHT;
  event.state = kobuki_msgs::BumperEvent::PRESSED;
  events.publish(event);
  ASSERT_TRUE(await([&] { return output.back().angular.z != -0.4; }));
  EXPECT_DOUBLE_EQ(output.back().angular.z, 0.4);
  event.state = kobuki_msgs::BumperEvent::RELEASED;
  events.publish(event);
}

TEST_F(VelocityChain, theSmootherLimitsAccelerationAndEndsAtZero) {
  std::vector<double> speeds;
  const auto subscriber =
      nh_.subscribe<Twist>("smoother_under_test/smooth_cmd_vel", 100,
                           [&](const geometry_msgs::TwistConstPtr& m) { speeds.push_back(m->linear.x); });
  auto input = connectedPublisher("smoother_under_test/raw_cmd_vel");
  ASSERT_TRUE(await([&] { return subscriber.getNumPublishers() > 0; }));
  ASSERT_TRUE(
      await([&] { return !speeds.empty() && speeds.back() == 0.5; }, [&] { input.publish(twist(0.5)); }));
  ASSERT_TRUE(await([&] { return speeds.back() == 0.0; }));
  const auto parameter = [this](const std::string& name) {
    double value = 0.0;
    EXPECT_TRUE(nh_.getParam("smoother_under_test/" + name, value)) << name;
    return value;
  };
  const double up = parameter("accel_lim_v") / parameter("frequency");
  const double down = parameter("decel_factor") * up;
  double last = 0.0;
  for (const double speed : speeds) {
    EXPECT_LE(speed - last, up + 1e-9);
    EXPECT_LE(last - speed, down + 1e-9);
    last = speed;
  }
  EXPECT_GE(static_cast<double>(speeds.size()), std::ceil(0.5 / up) + std::ceil(0.5 / down));
}

/// A robot in front of a wall: odometry and scans that follow from the commands that come out of the brake.
class BrakeTest : public VelocityChain {
 protected:
  BrakeTest() {
    scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
    output_subscriber_ =
        nh_.subscribe<Twist>("navigation_velocity_smoother/raw_cmd_vel", 100,
                             [this](const geometry_msgs::TwistConstPtr& m) { outputs_.push_back(*m); });
    braking_subscriber_ = nh_.subscribe<std_msgs::Bool>(
        "scan_brake/braking", 10, [this](const std_msgs::BoolConstPtr& m) { braking_ = m->data; });
    EXPECT_TRUE(await(
        [this] { return scans_.getNumSubscribers() > 0 && output_subscriber_.getNumPublishers() > 0; }));
  }

  void sendWorld(double wall) {
    const ros::Time now = ros::Time::now();
    if (!last_time_.isZero() && !outputs_.empty())
      x_ += outputs_.back().linear.x * (now - last_time_).toSec();
    last_time_ = now;
    for (const bool camera : {false, true}) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = now;
      transform.header.frame_id = camera ? "base_footprint" : "odom";
      transform.child_frame_id = camera ? "camera_depth_frame" : "base_footprint";
      transform.transform.translation.x = camera ? -0.087 : x_;
      transform.transform.rotation.w = 1.0;
      broadcaster_.sendTransform(transform);
    }
    sensor_msgs::LaserScan scan;
    scan.header.stamp = now;
    scan.header.frame_id = "camera_depth_frame";
    scan.angle_min = -0.51F;
    scan.angle_max = 0.51F;
    scan.angle_increment = 0.01F;
    scan.range_min = 0.45F;
    scan.range_max = 10.0F;
    for (int i = 0; i <= 102; ++i) {
      const double range = (wall - x_ + 0.087) / std::cos(-0.51 + 0.01 * i);
      const bool dead = i % 10 == 3 || range < 0.45;
      scan.ranges.push_back(dead ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(range));
    }
    scans_.publish(scan);
  }

  ros::Publisher scans_;
  ros::Subscriber output_subscriber_;
  ros::Subscriber braking_subscriber_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::vector<Twist> outputs_;
  bool braking_ = false;
  double x_ = 0.0;  // [m] of the robot in odom
  ros::Time last_time_;
};

TEST_F(BrakeTest, stopsInFrontOfAWallAndStandsWithoutAScan) {
  auto input = connectedPublisher("cmd_vel");
  // Without any scan it stands still.
  ASSERT_TRUE(await([this] { return outputs_.size() > 5; }, [&] { input.publish(twist(0.5)); }));
  for (const auto& sent : outputs_) EXPECT_DOUBLE_EQ(sent.linear.x, 0.0);
  // With scans it drives, slows down and stops in front of the wall.
  const double wall = 1.0;
  double fastest = 0.0;
  ASSERT_TRUE(await([&] { return fastest > 0.4 && outputs_.back().linear.x < 0.005; },
                    [&] {
                      sendWorld(wall);
                      input.publish(twist(0.5));
                      if (!outputs_.empty()) fastest = std::max(fastest, outputs_.back().linear.x);
                    }));
  EXPECT_LE(fastest, 0.5);
  EXPECT_TRUE(await([this] { return braking_; }));
  EXPECT_LT(x_, wall - 0.18 - 0.02);
  EXPECT_GT(x_, wall - 0.18 - 0.02 - 0.05 - 0.10);
  // Turning in place stays allowed.
  outputs_.clear();
  ASSERT_TRUE(await([this] { return !outputs_.empty() && outputs_.back().angular.z == 0.5; },
                    [&] {
                      sendWorld(wall);
                      input.publish(twist(0.5, 0.5));
                    }));
  // When the scans stop, it stands still altogether.
  ASSERT_TRUE(
      await([this] { return outputs_.back().angular.z == 0.0; }, [&] { input.publish(twist(0.0, 0.5)); }));
  // When the commands stop, it no longer calls itself braking.
  EXPECT_TRUE(await([this] { return !braking_; }));
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "velocity_chain_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
