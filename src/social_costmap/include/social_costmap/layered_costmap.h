// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sarn_common/cost_values.h"
#include "social_costmap/layer.h"

namespace social_costmap {

/// A master grid made by layers in order. Only the union of the layers' bounds is recomputed.
class LayeredCostmap {
 public:
  /// `default_cost`: what a cell holds before any layer writes it.
  explicit LayeredCostmap(std::uint8_t default_cost = sarn::kFreeSpace) : default_cost_(default_cost) {}

  /// Takes the layer over and returns it.
  template <class L>
  L& addLayer(std::unique_ptr<L> layer) {
    L& added = *layer;
    addLayerImpl(std::move(layer));
    return added;
  }
  /// Gives master and layers a new geometry; the next update recomputes everything.
  void resize(const sarn::GridGeometry& geometry);
  /// Every layer forgets its observations; the next update recomputes everything.
  void reset();
  /// Recomputes what changed and returns the bounds of what was recomputed.
  CellRect update(const UpdateContext& context);

  [[nodiscard]] const CostGrid& master() const { return master_; }
  [[nodiscard]] const sarn::GridGeometry& geometry() const { return master_.geometry; }
  /// Grows whenever an update recomputed at least one cell, or the size changed.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

 private:
  struct Entry {
    std::unique_ptr<Layer> layer;
    bool was_enabled;
  };
  void addLayerImpl(std::unique_ptr<Layer> layer);
  [[nodiscard]] CellRect collectBounds(const UpdateContext& context);
  void clear(const CellRect& bounds);

  std::uint8_t default_cost_;
  CostGrid master_;
  std::vector<Entry> layers_;
  bool recompute_all_ = true;
  std::uint64_t revision_ = 0;
};

}  // namespace social_costmap
