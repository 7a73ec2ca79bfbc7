// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/map_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace sarn {
namespace {

namespace fs = std::filesystem;

class MapIo : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("sarn_map_io_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  [[nodiscard]] std::string error(const fs::path& file) const {
    try {
      (void)loadMap(file);
    } catch (const MapError& e) {
      return e.what();
    }
    return "no error";
  }
  fs::path folder_;
};

constexpr char kYaml[] =
    "image: m.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: "
    "0.196\n";

TEST_F(MapIo, putsTheTopRowAtTheLargestY) {
  write("m.pgm", "P2\n# drawn by hand\n3 2\n255\n0 254 205\n254 254 0\n");
  const OccupancyMap map = loadMap(write("m.yaml", kYaml));
  EXPECT_EQ(map.geometry, (GridGeometry{3, 2, 0.5, -1.0, 2.0}));
  EXPECT_EQ(map.at({0, 1}), kMapOccupied);
  EXPECT_EQ(map.at({1, 1}), kMapFree);
  EXPECT_EQ(map.at({2, 1}), kMapUnknown);
  EXPECT_EQ(map.at({0, 0}), kMapFree);
  EXPECT_EQ(map.at({2, 0}), kMapOccupied);
}

TEST_F(MapIo, loadsWhatItSaved) {
  OccupancyMap map({4, 3, 0.05, -1.25, 7.5}, kMapFree);
  map.at({1, 2}) = kMapOccupied;
  map.at({3, 0}) = kMapUnknown;
  saveMap(map, folder_ / "saved");
  const OccupancyMap loaded = loadMap(folder_ / "saved.yaml");
  EXPECT_EQ(loaded.geometry, map.geometry);
  EXPECT_EQ(loaded.cells, map.cells);
}

TEST_F(MapIo, savesAPngWhereTheNameSaysSo) {
  OccupancyMap map({4, 3, 0.05, -1.25, 7.5}, kMapFree);
  map.at({1, 2}) = kMapOccupied;
  map.at({3, 0}) = kMapUnknown;
  saveMap(map, folder_ / "saved.png");
  EXPECT_FALSE(fs::exists(folder_ / "saved.pgm"));
  const OccupancyMap loaded = loadMap(folder_ / "saved.yaml");
  EXPECT_EQ(loaded.geometry, map.geometry);
  EXPECT_EQ(loaded.cells, map.cells);
  EXPECT_THROW(saveMap(map, folder_ / "nowhere" / "saved.png"), MapError);
}

TEST_F(MapIo, namesFileAndKeyOfEachMistake) {
  EXPECT_NE(error(folder_ / "absent.yaml").find("absent.yaml: no such map file"), std::string::npos);
  EXPECT_NE(error(write("a.yaml", "image: [")).find("not valid YAML"), std::string::npos);
  EXPECT_NE(error(write("b.yaml", "resolution: 1\n")).find("key 'image' is missing"), std::string::npos);
  EXPECT_NE(error(write("c.yaml", kYaml)).find("m.pgm: no such map image"), std::string::npos);
  write("m.pgm", "P5\n3 2\n255\nabc");
  EXPECT_NE(error(write("d.yaml", kYaml)).find("ends before its last pixel"), std::string::npos);
  write("m.pgm", "P5\n300000 2\n255\nabc");
  EXPECT_NE(error(write("e.yaml", kYaml)).find("300000 x 2 px"), std::string::npos);
  write("m.png", "not a png");
  std::string png = kYaml;
  png.replace(png.find("m.pgm"), 5, "m.png");
  EXPECT_NE(error(write("f.yaml", png)).find("m.png: not a PNG image"), std::string::npos);
  std::string turned = kYaml;
  turned.replace(turned.find("0.0]"), 3, "0.7");
  EXPECT_NE(error(write("g.yaml", turned)).find("key 'origin' has a yaw"), std::string::npos);
  std::string zero = kYaml;
  zero.replace(zero.find("resolution: 0.5"), 15, "resolution: 0.0");
  EXPECT_NE(error(write("h.yaml", zero)).find("key 'resolution' is 0"), std::string::npos);
}

}  // namespace
}  // namespace sarn
