// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sarn_common/grid.h"

namespace sarn {

/// Exact Euclidean distance [m] from each cell's centre to the nearest non-zero cell's centre (Felzenszwalb
/// and Huttenlocher 2012, lower envelope of parabolas); +infinity everywhere when no cell is occupied.
[[nodiscard]] Grid<float> distanceTransform(const Grid<std::uint8_t>& occupied);

}  // namespace sarn
