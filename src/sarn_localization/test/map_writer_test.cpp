// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/map_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <iterator>

#include "drawn_map.h"

namespace sarn_localization {
namespace {

namespace fs = std::filesystem;

class MapWriterTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(directory_); }
  void TearDown() override { fs::remove_all(directory_); }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(directory_), fs::directory_iterator());
  }
  fs::path directory_ = fs::temp_directory_path() / ("sarn_map_writer_" + std::to_string(getpid()));
};

TEST_F(MapWriterTest, writesWhatLoadMapReads) {
  const sarn::OccupancyMap map = drawnMap({"#.?", "..#"}, 0.05);
  writeMap(map, directory_ / "drawn");
  const sarn::OccupancyMap read = sarn::loadMap(directory_ / "drawn.yaml");
  EXPECT_EQ(read.geometry, map.geometry);
  EXPECT_EQ(read.cells, map.cells);
  EXPECT_EQ(files(), 2) << "nothing unfinished stays";
}

TEST_F(MapWriterTest, writesPngWhereTheNameSaysSo) {
  const sarn::OccupancyMap map = drawnMap({"#.?", "..#"}, 0.05);
  writeMap(map, directory_ / "drawn.png");
  EXPECT_TRUE(fs::exists(directory_ / "drawn.png"));
  const sarn::OccupancyMap read = sarn::loadMap(directory_ / "drawn.yaml");
  EXPECT_EQ(read.geometry, map.geometry);
  EXPECT_EQ(read.cells, map.cells);
  EXPECT_EQ(files(), 2);
}

TEST_F(MapWriterTest, replacesAnOlderMapAndCreatesDirectories) {
  writeMap(drawnMap({"#.", ".."}, 0.1), directory_ / "new" / "drawn");
  const sarn::OccupancyMap second = drawnMap({"##.", "..?"}, 0.05);
  writeMap(second, directory_ / "new" / "drawn");
  EXPECT_EQ(sarn::loadMap(directory_ / "new" / "drawn.yaml").cells, second.cells);
}

TEST_F(MapWriterTest, saysWhereItCannotWriteAndLeavesNothing) {
  writeMap(drawnMap({"#.", ".."}, 0.1), directory_ / "file");
  EXPECT_THROW(writeMap(drawnMap({"#.", ".."}, 0.1), directory_ / "file.pgm" / "drawn"), sarn::MapError);
  fs::create_directories(directory_ / "taken.pgm" / "full");
  EXPECT_THROW(writeMap(drawnMap({"#.", ".."}, 0.1), directory_ / "taken"), sarn::MapError);
  EXPECT_FALSE(fs::exists(directory_ / "taken.yaml"));
}

}  // namespace
}  // namespace sarn_localization
