// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/map_writer.h"

#include <string>
#include <system_error>

namespace sarn_localization {

namespace fs = std::filesystem;

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
    sarn::saveMap(map, waiting / base.filename());
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
