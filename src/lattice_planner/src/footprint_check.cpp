// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/footprint_check.h"

#include <algorithm>
#include <utility>

#include "sarn_common/cost_values.h"

namespace lattice_planner {

FootprintCheck::FootprintCheck(Footprint footprint, bool allow_unknown) : footprint_(std::move(footprint)) {
  blocked_static_[sarn::kLethalObstacle] = true;
  blocked_static_[sarn::kNoInformation] = !allow_unknown;
  blocked_social_[sarn::kLethalObstacle] = true;
}

void FootprintCheck::reset(const sarn::TimedCostmapView& costmap) {
  if (!active()) return;
  costmap_ = costmap;
  if (resolution_ != costmap.geometry.resolution) {
    resolution_ = costmap.geometry.resolution;
    body_ = FootprintMasks(footprint_.corners, resolution_);
    core_ = FootprintMasks(coreOf(footprint_), resolution_);
  }
  layers_.resize(std::max(layers_.size(), costmap.layers.size() + 1));
  prepared_.assign(layers_.size(), false);
}

int FootprintCheck::touched(const BlockedCells& cells, const FootprintMasks& masks, const sarn::Pose2D& pose,
                            int enough) const {
  const sarn::GridGeometry& g = costmap_.geometry;
  const double column = (pose.x - g.origin_x) / g.resolution;
  const double row = (pose.y - g.origin_y) / g.resolution;
  const sarn::CellIndex cell{static_cast<int>(column), static_cast<int>(row)};
  if (!cells.near(cell)) return 0;
  return cells.touched(cell, masks.at(column - cell.x, row - cell.y, pose.theta), enough);
}

int FootprintCheck::touchedStatic(const sarn::Pose2D& pose, int enough) {
  if (!prepared_[0]) {
    layers_[0].reset(costmap_.geometry, costmap_.static_costs, blocked_static_, body_.reach());
    prepared_[0] = true;
  }
  return touched(layers_[0], body_, pose, enough);
}

int FootprintCheck::touchedPeople(const sarn::Pose2D& pose, int layer, int enough) {
  if (layer < 0) return 0;
  const auto i = static_cast<std::size_t>(layer) + 1;
  if (!prepared_[i]) {
    layers_[i].reset(costmap_.geometry, costmap_.layers[i - 1], blocked_social_, core_.reach());
    prepared_[i] = true;
  }
  return touched(layers_[i], core_, pose, enough);
}

}  // namespace lattice_planner
