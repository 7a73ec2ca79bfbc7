// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/GetMap.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sarn_common_ros/call_service.h"

namespace {

// Rows from the smallest y: the image's last row first.
const std::vector<std::int8_t> kExpectedCells = {0, 0, 100, 100, 0, -1};
const ros::Duration kPatience(20.0);

void expectTinyMap(const nav_msgs::OccupancyGrid& map) {
  EXPECT_EQ(map.header.frame_id, "world");
  EXPECT_EQ(map.info.width, 3U);
  EXPECT_EQ(map.info.height, 2U);
  EXPECT_FLOAT_EQ(map.info.resolution, 0.5F);
  EXPECT_DOUBLE_EQ(map.info.origin.position.x, -1.0);
  EXPECT_DOUBLE_EQ(map.info.origin.position.y, 2.0);
  EXPECT_DOUBLE_EQ(map.info.origin.orientation.w, 1.0);
  EXPECT_EQ(map.data, kExpectedCells);
}

TEST(MapServer, latchesMapAndMetadata) {
  const auto map = ros::topic::waitForMessage<nav_msgs::OccupancyGrid>("/map", kPatience);
  ASSERT_TRUE(map);
  expectTinyMap(*map);
  const auto metadata = ros::topic::waitForMessage<nav_msgs::MapMetaData>("/map_metadata", kPatience);
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->width, 3U);
}

TEST(MapServer, servesStaticMap) {
  ASSERT_TRUE(ros::service::waitForService("/static_map", kPatience));
  nav_msgs::GetMap call;
  ASSERT_TRUE(sarn::callService("/static_map", call));
  expectTinyMap(call.response.map);
}

/// Exit code and output of a map_server with these arguments.
std::pair<int, std::string> runMapServer(const std::string& arguments) {
  const std::string output_file = "/tmp/sarn_map_server_" + std::to_string(getpid());
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "map_server";
  const std::string command = program.string() + " " + arguments + " >" + output_file + " 2>&1";
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c)
  std::stringstream output;
  output << std::ifstream(output_file).rdbuf();
  std::remove(output_file.c_str());
  return {WEXITSTATUS(status), output.str()};
}

TEST(MapServer, refusesABrokenMapNamingFileAndKey) {
  const std::string maps = ros::param::param<std::string>("~maps", "");
  const auto [code, output] = runMapServer(maps + "/broken.yaml __name:=broken_map_server");
  EXPECT_EQ(code, 1);
  EXPECT_NE(output.find("broken.yaml"), std::string::npos) << output;
  EXPECT_NE(output.find("resolution"), std::string::npos) << output;
}

TEST(MapServer, refusesAMissingMapNamingTheFile) {
  const auto [code, output] = runMapServer("/nowhere/missing.yaml __name:=missing_map_server");
  EXPECT_EQ(code, 1);
  EXPECT_NE(output.find("/nowhere/missing.yaml"), std::string::npos) << output;
}

TEST(MapServer, refusesToStartWithoutAMap) { EXPECT_EQ(runMapServer("__name:=no_map_server").first, 1); }

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "map_server_rostest");
  const ros::NodeHandle nh;  // keeps the node alive
  return RUN_ALL_TESTS();
}
