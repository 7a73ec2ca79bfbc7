// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/static_layer.h"

#include <algorithm>
#include <utility>

#include "sarn_common/cost_values.h"

namespace social_costmap {

StaticLayer::StaticLayer(const StaticLayerParams& params, std::string name)
    : Layer(std::move(name)), params_(params) {
  setEnabled(params.enabled);
}

void StaticLayer::setMap(sarn::OccupancyMap map) {
  map_ = std::move(map);
  sampleMap();
}

std::uint8_t StaticLayer::cost(std::int8_t occupancy) const {
  if (occupancy < 0) return params_.track_unknown_space ? sarn::kNoInformation : sarn::kFreeSpace;
  return occupancy >= params_.lethal_cost_threshold ? sarn::kLethalObstacle : sarn::kFreeSpace;
}

void StaticLayer::sampleMap() {
  for (int y = 0; y < costs_.geometry.height; ++y) {
    for (int x = 0; x < costs_.geometry.width; ++x) {
      const Eigen::Vector2d center = costs_.geometry.center({x, y});
      const auto cell = map_.geometry.cellAt(center.x(), center.y());
      costs_.at({x, y}) = cost(cell ? map_.at(*cell) : sarn::kMapUnknown);
    }
  }
  changed_ = true;
}

void StaticLayer::matchSize(const sarn::GridGeometry& geometry) {
  costs_ = CostGrid(geometry, sarn::kNoInformation);
  sampleMap();
}

void StaticLayer::reset() { changed_ = true; }

void StaticLayer::updateBounds(const UpdateContext&, CellRect& bounds) {
  if (std::exchange(changed_, false)) bounds = CellRect::whole(costs_.geometry);
}

void StaticLayer::updateCosts(CostGrid& master, const CellRect& bounds) {
  for (int y = bounds.min_y; y < bounds.max_y; ++y) {
    std::copy_n(&costs_.at({bounds.min_x, y}), bounds.width(), &master.at({bounds.min_x, y}));
  }
}

}  // namespace social_costmap
