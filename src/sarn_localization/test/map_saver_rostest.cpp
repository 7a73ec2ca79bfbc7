// SPDX-License-Identifier: BSD-3-Clause
// What map_server publishes, map_saver writes.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "sarn_common/map_io.h"

namespace {

namespace fs = std::filesystem;

TEST(MapSaver, writesTheMapThatIsPublished) {
  const fs::path directory = fs::temp_directory_path() / ("sarn_map_saver_" + std::to_string(getpid()));
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "map_saver";
  const std::string command = program.string() + " -f " + (directory / "copy").string();
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c)
  const sarn::OccupancyMap original = sarn::loadMap(ros::param::param<std::string>("~map", ""));
  const sarn::OccupancyMap copy = sarn::loadMap(directory / "copy.yaml");
  EXPECT_EQ(copy.geometry, original.geometry);
  EXPECT_EQ(copy.cells, original.cells);
  fs::remove_all(directory);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "map_saver_rostest");
  const ros::NodeHandle nh;  // keeps the node alive
  return RUN_ALL_TESTS();
}
