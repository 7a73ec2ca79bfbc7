// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sarn_common/grid.h"
#include "social_costmap/cell_rect.h"
#include "social_costmap/group_space.h"
#include "social_costmap/person_space.h"

namespace social_costmap {

// Paint costs into a row-major grid; cells take the larger of old and new cost. Each returns the rectangle
// that holds every cell it may have changed. Whatever lies outside the grid is left out, coordinates may be
// as large as kMaxCoordinate. Costs are truncated to integers and agree with the formula to within one.

/// Costs below `cutoff` > 0 are not written.
CellRect paint(const SweptGaussian& gaussian, double cutoff, const sarn::GridGeometry& grid,
               std::uint8_t* cells);

/// Lethal where the cell's centre is within the radius; the cell that holds a person always is when radius >
/// 0.
CellRect paint(const SweptDisc& disc, const sarn::GridGeometry& grid, std::uint8_t* cells);

/// amplitude * exp(-d^2 / (2 sigma^2)) at distance d from the polygon.
CellRect paint(const Polygon& polygon, double amplitude, double sigma, double cutoff,
               const sarn::GridGeometry& grid, std::uint8_t* cells);

}  // namespace social_costmap
