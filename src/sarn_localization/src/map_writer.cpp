// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/map_writer.h"

#include <png.h>

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace sarn_localization {

namespace fs = std::filesystem;

namespace {

/// The PGM (P5, as sarn::saveMap writes it) as a PNG of the same pixels.
void writePng(const sarn::GridGeometry& grid, const fs::path& pgm, const fs::path& file) {
  std::ifstream in(pgm, std::ios::binary);
  std::vector<char> pixels(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  in.seekg(-static_cast<std::streamoff>(pixels.size()), std::ios::end);
  in.read(pixels.data(), static_cast<std::streamsize>(pixels.size()));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(grid.width);
  image.height = static_cast<png_uint_32>(grid.height);
  image.format = PNG_FORMAT_GRAY;
  if (!in || png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr) == 0) {
    throw sarn::MapError(file.string() + ": cannot be written: " + image.message);
  }
}

/// What saveMap wrote beside `stem`, with a PNG in the PGM's place.
void turnIntoPng(const sarn::OccupancyMap& map, const fs::path& stem) {
  const std::string pgm = stem.string() + ".pgm";
  writePng(map.geometry, pgm, stem.string() + ".png");
  fs::remove(pgm);
  std::ifstream in(stem.string() + ".yaml");
  std::string yaml{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = yaml.find(".pgm\n");
  yaml.replace(at, 4, ".png");
  std::ofstream out(stem.string() + ".yaml");
  out << yaml;
  out.close();
  if (!out) throw sarn::MapError(stem.string() + ".yaml: cannot be written");
}

}  // namespace

void writeMap(const sarn::OccupancyMap& map, const fs::path& base) {
  const bool png = base.extension() == ".png";
  fs::path place = fs::absolute(base);
  if (png) place.replace_extension();
  // A directory of its own beside the place: on the same file system, so that renaming is atomic.
  const fs::path waiting = place.parent_path() / ("." + place.filename().string() + ".unfinished");
  std::error_code error;
  fs::create_directories(waiting, error);
  if (error) throw sarn::MapError(waiting.string() + ": cannot be created: " + error.message());
  try {
    sarn::saveMap(map, waiting / place.filename());
    if (png) turnIntoPng(map, waiting / place.filename());
    for (const char* extension : {png ? ".png" : ".pgm", ".yaml"}) {
      fs::rename((waiting / place.filename()).string() + extension, place.string() + extension);
    }
  } catch (const fs::filesystem_error& failure) {
    fs::remove_all(waiting, error);
    throw sarn::MapError(place.string() + ": cannot be written: " + failure.code().message());
  } catch (...) {
    fs::remove_all(waiting, error);
    throw;
  }
  fs::remove_all(waiting, error);
}

}  // namespace sarn_localization
