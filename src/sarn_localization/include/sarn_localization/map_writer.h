// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "sarn_common/map_io.h"

namespace sarn_localization {

/// Writes `base`.pgm and `base`.yaml as sarn::saveMap does, or `base` and its YAML where it ends in .png; but
/// so that nobody ever finds half a file: they are written beside their places and renamed, the YAML last.
/// Missing directories are created. Throws sarn::MapError; then the old files are as they were.
void writeMap(const sarn::OccupancyMap& map, const std::filesystem::path& base);

}  // namespace sarn_localization
