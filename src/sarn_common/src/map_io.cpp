// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/map_io.h"

#include <png.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace sarn {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxEdge = 16384;  // [px] of an image; a larger one is taken for a damaged header

/// Grey image, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

[[noreturn]] void fail(const fs::path& file, const std::string& problem) {
  throw MapError(file.string() + ": " + problem);
}

void checkSize(const fs::path& file, long width, long height) {
  if (width < 1 || height < 1 || width > kMaxEdge || height > kMaxEdge) {
    fail(file, "image of " + std::to_string(width) + " x " + std::to_string(height) +
                   " px; edges must be 1 to " + std::to_string(kMaxEdge));
  }
}

/// Next number of a PNM header; '#' starts a comment.
long pnmNumber(std::istream& in, const fs::path& file) {
  while (in) {
    in >> std::ws;
    if (in.peek() != '#') break;
    std::string comment;
    std::getline(in, comment);
  }
  long value = -1;
  if (!(in >> value)) fail(file, "header is not that of a PGM image (P2 or P5)");
  return value;
}

Image readPgm(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be opened");
  std::string magic;
  in >> magic;
  if (magic != "P5" && magic != "P2") fail(file, "not a PGM image (P2 or P5)");
  const long width = pnmNumber(in, file);
  const long height = pnmNumber(in, file);
  const long maximum = pnmNumber(in, file);
  checkSize(file, width, height);
  if (maximum < 1 || maximum > 255)
    fail(file, "grey levels must be 1 to 255, not " + std::to_string(maximum));
  Image image{static_cast<int>(width), static_cast<int>(height), {}};
  image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (magic == "P5") {
    in.get();  // the single white space after the header
    in.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(image.pixels.size()));
    if (in.gcount() != static_cast<std::streamsize>(image.pixels.size()))
      fail(file, "ends before its last pixel");
  } else {
    for (auto& pixel : image.pixels) {
      const long value = pnmNumber(in, file);
      if (value < 0 || value > maximum)
        fail(file, "grey value " + std::to_string(value) + " is out of range");
      pixel = static_cast<std::uint8_t>(value);
    }
  }
  if (maximum != 255) {
    for (auto& pixel : image.pixels) {
      pixel = static_cast<std::uint8_t>(std::min(255L, static_cast<long>(pixel) * 255L / maximum));
    }
  }
  return image;
}

Image readPng(const fs::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0)
    fail(file, std::string("not a PNG image: ") + png.message);
  png.format = PNG_FORMAT_GRAY;
  const Image header{static_cast<int>(std::min<png_uint_32>(png.width, kMaxEdge + 1)),
                     static_cast<int>(std::min<png_uint_32>(png.height, kMaxEdge + 1)),
                     {}};
  if (header.width > kMaxEdge || header.height > kMaxEdge) png_image_free(&png);
  checkSize(file, header.width, header.height);
  Image image = header;
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&png, &white, image.pixels.data(), 0, nullptr) == 0) {
    fail(file, std::string("damaged PNG image: ") + png.message);
  }
  return image;
}

Image readImage(const fs::path& file) {
  if (!fs::is_regular_file(file)) fail(file, "no such map image");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".png") return readPng(file);
  if (extension == ".pgm") return readPgm(file);
  fail(file, "map images are .pgm or .png");
}

template <class T>
T value(const YAML::Node& yaml, const char* key, const fs::path& file, const char* expected) {
  if (!yaml[key]) fail(file, std::string("key '") + key + "' is missing: " + expected);
  try {
    return yaml[key].as<T>();
  } catch (const YAML::Exception&) {
    fail(file, std::string("key '") + key + "' must be " + expected);
  }
}

double number(const YAML::Node& yaml, const char* key, const fs::path& file, double min, double max) {
  const auto result = value<double>(yaml, key, file, "a number");
  if (!(result >= min && result <= max)) {
    std::ostringstream text;
    text << "key '" << key << "' is " << result << "; it must be in [" << min << ", " << max << "]";
    fail(file, text.str());
  }
  return result;
}

/// map_server's settings of one map.
struct MapSettings {
  fs::path image;
  double resolution = 0.05;  // [m]
  double origin_x = 0.0;     // [m]
  double origin_y = 0.0;     // [m]
  bool negate = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
};

MapSettings readSettings(const fs::path& file) {
  if (!fs::is_regular_file(file)) fail(file, "no such map file");
  YAML::Node yaml;
  try {
    yaml = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& error) {
    fail(file, "not valid YAML: " + error.msg + " in line " + std::to_string(error.mark.line + 1));
  }
  if (!yaml.IsMap()) fail(file, "not a map of keys to values");
  MapSettings settings;
  settings.image = value<std::string>(yaml, "image", file, "a file name");
  if (settings.image.is_relative()) settings.image = file.parent_path() / settings.image;
  settings.resolution = number(yaml, "resolution", file, 1e-3, 10.0);
  const auto origin = value<std::vector<double>>(yaml, "origin", file, "[x, y, yaw]");
  if (origin.size() != 3 ||
      !std::all_of(origin.begin(), origin.end(), [](double v) { return std::isfinite(v); })) {
    fail(file, "key 'origin' must be [x, y, yaw] of finite numbers");
  }
  if (std::abs(origin[2]) > 1e-9) fail(file, "key 'origin' has a yaw; only maps with yaw 0 are supported");
  settings.origin_x = origin[0];
  settings.origin_y = origin[1];
  if (yaml["negate"]) settings.negate = value<int>(yaml, "negate", file, "0 or 1") != 0;
  if (yaml["mode"] && value<std::string>(yaml, "mode", file, "trinary") != "trinary") {
    fail(file, "key 'mode' must be trinary");
  }
  settings.occupied_thresh = number(yaml, "occupied_thresh", file, 0.0, 1.0);
  settings.free_thresh = number(yaml, "free_thresh", file, 0.0, settings.occupied_thresh);
  return settings;
}

/// Shades of grey of map_server's convention, top row first.
std::vector<std::uint8_t> greyPixels(const OccupancyMap& map) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.cells.size());
  for (int row = map.geometry.height - 1; row >= 0; --row) {
    for (int column = 0; column < map.geometry.width; ++column) {
      const std::int8_t cell = map.at({column, row});
      pixels.push_back(cell == kMapUnknown ? 205 : cell >= 65 ? 0 : cell < 20 ? 254 : 205);
    }
  }
  return pixels;
}

void writePgm(const GridGeometry& grid, const std::vector<std::uint8_t>& pixels, const fs::path& file) {
  std::ofstream image(file, std::ios::binary);
  image << "P5\n" << grid.width << " " << grid.height << "\n255\n";
  for (const std::uint8_t pixel : pixels) image.put(static_cast<char>(pixel));
  image.close();
  if (!image) fail(file, "cannot be written");
}

void writePng(const GridGeometry& grid, const std::vector<std::uint8_t>& pixels, const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(grid.width);
  image.height = static_cast<png_uint_32>(grid.height);
  image.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr) == 0) {
    fail(file, std::string("cannot be written: ") + image.message);
  }
}

}  // namespace

OccupancyMap loadMap(const fs::path& yaml_file) {
  const MapSettings settings = readSettings(yaml_file);
  const Image image = readImage(settings.image);
  OccupancyMap map({image.width, image.height, settings.resolution, settings.origin_x, settings.origin_y},
                   kMapUnknown);
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double grey = image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                       static_cast<std::size_t>(column)];
      const double occupancy = settings.negate ? grey / 255.0 : (255.0 - grey) / 255.0;
      std::int8_t& cell = map.at({column, image.height - 1 - row});
      if (occupancy > settings.occupied_thresh) {
        cell = kMapOccupied;
      } else if (occupancy < settings.free_thresh) {
        cell = kMapFree;
      }
    }
  }
  return map;
}

void saveMap(const OccupancyMap& map, const fs::path& base) {
  const bool png = base.extension() == ".png";
  const fs::path image_file = png ? base : fs::path(base.string() + ".pgm");
  const fs::path yaml_file =
      png ? fs::path(base).replace_extension(".yaml") : fs::path(base.string() + ".yaml");
  (png ? writePng : writePgm)(map.geometry, greyPixels(map), image_file);
  std::ofstream yaml(yaml_file);
  yaml << "image: " << image_file.filename().string() << "\nresolution: " << map.geometry.resolution
       << "\norigin: [" << map.geometry.origin_x << ", " << map.geometry.origin_y
       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  yaml.close();
  if (!yaml) fail(yaml_file, "cannot be written");
}

}  // namespace sarn
