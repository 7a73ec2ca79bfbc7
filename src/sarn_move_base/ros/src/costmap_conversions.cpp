// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/costmap_conversions.h"

#include <boost/thread/locks.hpp>
#include <cstddef>

namespace sarn_move_base {

sarn::GridGeometry geometryOf(const costmap_2d::Costmap2D& costmap) {
  return {static_cast<int>(costmap.getSizeInCellsX()), static_cast<int>(costmap.getSizeInCellsY()),
          costmap.getResolution(), costmap.getOriginX(), costmap.getOriginY()};
}

void copyCosts(costmap_2d::Costmap2D& costmap, sarn::Grid<std::uint8_t>& costs) {
  const boost::unique_lock<costmap_2d::Costmap2D::mutex_t> lock(*costmap.getMutex());
  costs.geometry = geometryOf(costmap);
  const unsigned char* cells = costmap.getCharMap();
  costs.cells.assign(cells, cells + static_cast<std::ptrdiff_t>(costs.geometry.size()));
}

}  // namespace sarn_move_base
