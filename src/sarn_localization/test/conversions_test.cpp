// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization_ros/conversions.h"

#include <gtest/gtest.h>

#include <limits>

#include "sarn_localization_ros/scan_order.h"

namespace sarn_localization {
namespace {

sensor_msgs::LaserScan goodScan() {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -0.5F;
  scan.angle_increment = 0.1F;
  scan.range_min = 0.45F;
  scan.range_max = 10.0F;
  scan.ranges.assign(11, 2.0F);
  return scan;
}

TEST(ScanProblem, acceptsNanAndInfAmongTheRanges) {
  sensor_msgs::LaserScan scan = goodScan();
  scan.ranges[3] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges[4] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(scanProblem(scan), "");
}

TEST(ScanProblem, namesTheFieldAtFault) {
  sensor_msgs::LaserScan scan = goodScan();
  scan.ranges.clear();
  EXPECT_NE(scanProblem(scan).find("ranges"), std::string::npos);
  scan = goodScan();
  scan.angle_increment = 0.0F;
  EXPECT_NE(scanProblem(scan).find("angle_increment"), std::string::npos);
  scan = goodScan();
  scan.angle_min = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(scanProblem(scan).find("angle_min"), std::string::npos);
  scan = goodScan();
  scan.range_max = 0.1F;
  EXPECT_NE(scanProblem(scan).find("range_max"), std::string::npos);
}

TEST(PoseWithCovariance, survivesTheRoundTrip) {
  PoseEstimate estimate{{1.0, -2.0, 0.7}, Eigen::Matrix3d::Zero()};
  estimate.covariance << 0.3, 0.01, 0.02, 0.01, 0.4, 0.03, 0.02, 0.03, 0.5;
  const geometry_msgs::PoseWithCovariance message = toMessage(estimate);
  EXPECT_DOUBLE_EQ(message.covariance[7], 0.4);   // y, y
  EXPECT_DOUBLE_EQ(message.covariance[35], 0.5);  // yaw, yaw
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->pose.theta, 0.7, 1e-12);
  EXPECT_TRUE(back->covariance.isApprox(estimate.covariance));
}

TEST(PoseWithCovariance, refusesNanNegativeVariancesAndTiltedPoses) {
  PoseEstimate estimate;
  geometry_msgs::PoseWithCovariance message = toMessage(estimate);
  message.covariance[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(estimate);
  message.covariance[35] = -0.1;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(estimate);
  message.pose.orientation.x = 0.7;
  message.pose.orientation.w = 0.7;
  EXPECT_FALSE(fromMessage(message));
}

TEST(ScanOrderGuard, tellsStampsThatCannotBeUsed) {
  ScanOrderGuard guard(1.0);
  EXPECT_EQ(guard.check(ros::Time(10.0), ros::Time(10.1)), ScanOrder::kNext);
  EXPECT_EQ(guard.check(ros::Time(10.0), ros::Time(10.2)), ScanOrder::kOutOfOrder);
  EXPECT_EQ(guard.check(ros::Time(9.0), ros::Time(10.2)), ScanOrder::kOutOfOrder);
  EXPECT_EQ(guard.check(ros::Time(20.0), ros::Time(10.3)), ScanOrder::kFuture);
  EXPECT_EQ(guard.check(ros::Time(10.1), ros::Time(10.4)), ScanOrder::kNext);
}

TEST(ScanOrderGuard, beginsAnewWhenTheClockJumpsBack) {
  ScanOrderGuard guard(1.0);
  EXPECT_EQ(guard.check(ros::Time(100.0), ros::Time(100.0)), ScanOrder::kNext);
  EXPECT_EQ(guard.check(ros::Time(5.0), ros::Time(5.0)), ScanOrder::kClockJumpedBack);
  EXPECT_EQ(guard.check(ros::Time(5.1), ros::Time(5.1)), ScanOrder::kNext);
}

}  // namespace
}  // namespace sarn_localization
