// SPDX-License-Identifier: BSD-3-Clause
// The node slam in a world of this test.
#include <nav_msgs/GetMap.h>
#include <nav_msgs/MapMetaData.h>
#include <nav_msgs/OccupancyGrid.h>

#include <limits>

#include "sarn_common_ros/call_service.h"
#include "scan_node_fixture.h"

namespace sarn_localization {
namespace {

/// The node's map begins at the robot's start, by its parameters initial_pose_*: poses in it are the room's.
class SlamNodeTest : public ScanNodeTest {
 protected:
  SlamNodeTest() : ScanNodeTest("slam") { odometry_twist_ = {0.503, 0.402}; }

  void SetUp() override {
    maps_ = nh_.subscribe<nav_msgs::OccupancyGrid>(
        "map", 10, [this](const nav_msgs::OccupancyGridConstPtr& map) { map_ = *map; });
    metadata_ = nh_.subscribe<nav_msgs::MapMetaData>(
        "map_metadata", 10, [this](const nav_msgs::MapMetaDataConstPtr& data) { width_ = data->width; });
    ScanNodeTest::SetUp();
    tick(1.0);
    publishOdometry(now_);
  }

  /// Share of the map's walls that lie within `distance` [m] of the room's.
  [[nodiscard]] double shareOfWallsWithin(double distance) const {
    const auto map = sarn::fromMessage(*map_);
    int right = 0;
    int all = 0;
    for (int y = 0; y < map->geometry.height; ++y) {
      for (int x = 0; x < map->geometry.width; ++x) {
        if (map->at({x, y}) != sarn::kMapOccupied) continue;
        ++all;
        if (walls_.at(map->geometry.center({x, y}), 1.0) <= distance) ++right;
      }
    }
    return all > 0 ? static_cast<double>(right) / all : 0.0;
  }

  ros::Subscriber maps_, metadata_;
  std::optional<nav_msgs::OccupancyGrid> map_;
  unsigned width_ = 0;
};

TEST_F(SlamNodeTest, drawsTheRoomAndKnowsWhereTheRobotIs) {
  ASSERT_TRUE(await([this] {  // the first scan is of the start
    scan_.publish(scanNow());
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    return map_from_odom_.has_value();
  }));
  for (int i = 0; i < 200; ++i) drive();  // one and a quarter rounds
  ASSERT_TRUE(await([this] { return map_ && map_from_odom_; }));
  EXPECT_EQ(map_->header.frame_id, "map");
  EXPECT_EQ(map_from_odom_->header.frame_id, "map");
  EXPECT_GT(shareOfWallsWithin(0.10), 0.95);
  EXPECT_LT(error(), 0.15);
  EXPECT_TRUE(await([this] { return map_from_odom_->header.stamp >= now_ + ros::Duration(0.19); }))
      << "the newest odometry can be looked up in map";
  nav_msgs::GetMap call;
  ASSERT_TRUE(sarn::callService("dynamic_map", call));
  EXPECT_GE(call.response.map.data.size(), map_->data.size()) << "as large as the last one, or grown since";
  EXPECT_EQ(width_, map_->info.width);
}

TEST_F(SlamNodeTest, survivesBadInputWithALineEach) {
  // The node has gone on from the test before; what is asked here is that it goes on further.
  for (int i = 0; i < 5; ++i) drive();
  tick(kStep);
  publishOdometry(now_);
  sensor_msgs::LaserScan old = scanNow();
  old.header.stamp -= ros::Duration(0.55);
  scan_.publish(old);
  EXPECT_TRUE(await([&] { return warnings("is not after the last one") > 0; }));

  move();
  sensor_msgs::LaserScan no_increment = scanNow();
  no_increment.angle_increment = 0.0F;
  scan_.publish(no_increment);
  EXPECT_TRUE(await([&] { return warnings("angle_increment") > 0; }));

  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    move();
    sensor_msgs::LaserScan nothing = scanNow();
    nothing.ranges.assign(nothing.ranges.size(), value);
    scan_.publish(nothing);
  }
  // Scans whose transform never comes push each other out of the queue.
  EXPECT_TRUE(await([&] {
    move();
    sensor_msgs::LaserScan foreign = scanNow();
    foreign.header.frame_id = "nowhere";
    scan_.publish(foreign);
    return warnings("'nowhere'") > 0;
  }));
  for (int i = 0; i < 10; ++i) drive(80);
  EXPECT_GT(warnings("80 beams"), 0);
  ASSERT_TRUE(map_from_odom_);
  EXPECT_TRUE(sarn::fromMessage(map_from_odom_->transform)) << "finite and level";
}

}  // namespace
}  // namespace sarn_localization

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "slam_rostest");
  const ros::NodeHandle nh;  // keeps the node alive
  return RUN_ALL_TESTS();
}
