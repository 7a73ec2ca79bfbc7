// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/layered_costmap.h"

#include <algorithm>
#include <utility>

namespace social_costmap {

void LayeredCostmap::addLayerImpl(std::unique_ptr<Layer> layer) {
  layer->matchSize(master_.geometry);
  layers_.push_back({std::move(layer), false});
  recompute_all_ = true;
}

void LayeredCostmap::resize(const sarn::GridGeometry& geometry) {
  master_ = CostGrid(geometry, default_cost_);
  for (const Entry& entry : layers_) entry.layer->matchSize(geometry);
  recompute_all_ = true;
  ++revision_;
}

void LayeredCostmap::reset() {
  for (const Entry& entry : layers_) entry.layer->reset();
  recompute_all_ = true;
}

CellRect LayeredCostmap::collectBounds(const UpdateContext& context) {
  CellRect bounds;
  const CellRect everything = CellRect::whole(master_.geometry);
  if (std::exchange(recompute_all_, false)) bounds = everything;
  for (Entry& entry : layers_) {
    const bool enabled = entry.layer->enabled();
    if (std::exchange(entry.was_enabled, enabled) != enabled) bounds = everything;
    if (enabled) entry.layer->updateBounds(context, bounds);
  }
  return bounds.clipped(master_.geometry);
}

void LayeredCostmap::clear(const CellRect& bounds) {
  for (int y = bounds.min_y; y < bounds.max_y; ++y) {
    std::fill_n(&master_.at({bounds.min_x, y}), bounds.width(), default_cost_);
  }
}

CellRect LayeredCostmap::update(const UpdateContext& context) {
  const CellRect bounds = collectBounds(context);
  if (bounds.empty()) return {};
  clear(bounds);
  for (const Entry& entry : layers_) {
    if (entry.layer->enabled()) entry.layer->updateCosts(master_, bounds);
  }
  ++revision_;
  return bounds;
}

}  // namespace social_costmap
