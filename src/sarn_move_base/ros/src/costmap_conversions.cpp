// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/costmap_conversions.h"

#include <boost/thread/locks.hpp>
#include <cstddef>
#include <utility>
#include <vector>

namespace sarn_move_base {
namespace {

constexpr double kRound = 0.95;  // inscribed radius / circumscribed radius from which on a robot is a disc

}  // namespace

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

sarn::TimedCostmapView viewOf(const costmap_2d::Costmap2D& costmap) {
  sarn::TimedCostmapView view;
  view.geometry = geometryOf(costmap);
  view.static_costs = costmap.getCharMap();
  return view;
}

lattice_planner::Footprint footprintOf(const costmap_2d::Costmap2DROS& costmap) {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& corner : costmap.getRobotFootprint()) corners.emplace_back(corner.x, corner.y);
  auto footprint = lattice_planner::makeFootprint(std::move(corners));
  if (footprint.inscribed_radius >= kRound * footprint.circumscribed_radius) return {};
  return footprint;
}

}  // namespace sarn_move_base
