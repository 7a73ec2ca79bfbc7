// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/social_layer.h"

#include <algorithm>
#include <utility>

#include "sarn_common/cost_values.h"

namespace social_costmap {
namespace {

SocialParams oneLayer(SocialParams params) {
  params.num_layers = 1;
  return params;
}

}  // namespace

SocialLayer::SocialLayer(SocialParams params, std::string name)
    : Layer(std::move(name)), layers_(oneLayer(params)) {
  setEnabled(params.enabled);
}

void SocialLayer::setPrediction(sarn::PeoplePrediction prediction) { prediction_ = std::move(prediction); }

void SocialLayer::matchSize(const sarn::GridGeometry& geometry) { layers_.resize(geometry); }

void SocialLayer::reset() { prediction_.people.clear(); }

CellRect SocialLayer::painted() const {
  CellRect all;
  for (const CellRect& rect : layers_.timeLayers().front().painted) all.unite(rect);
  return all;
}

void SocialLayer::updateBounds(const UpdateContext& context, CellRect& bounds) {
  bounds.unite(painted());  // where people were
  layers_.update(prediction_, context.now);
  bounds.unite(painted());
}

void SocialLayer::updateCosts(CostGrid& master, const CellRect& bounds) {
  const TimeLayer& people = layers_.timeLayers().front();
  for (int y = bounds.min_y; y < bounds.max_y; ++y) {
    for (int x = bounds.min_x; x < bounds.max_x; ++x) {
      std::uint8_t& cost = master.at({x, y});
      if (cost != sarn::kNoInformation) cost = std::max(cost, people.cells[master.geometry.index({x, y})]);
    }
  }
}

}  // namespace social_costmap
