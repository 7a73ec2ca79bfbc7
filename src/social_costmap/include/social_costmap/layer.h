// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "sarn_common/grid.h"
#include "sarn_common/pose2d.h"
#include "social_costmap/cell_rect.h"

namespace social_costmap {

using CostGrid = sarn::Grid<std::uint8_t>;  // values of sarn_common/cost_values.h

/// What a layer may know when the costmap is updated.
struct UpdateContext {
  sarn::Pose2D robot_in_map;
  double now = 0.0;  // [s]
};

/// One source of costs (costmap_2d's layer contract: Lu, Hershberger and Smart 2014, "Layered costmaps for
/// context-sensitive navigation"). Each update first asks every layer which cells it wants to change, resets
/// these cells, then lets the layers write them in order. A layer writes nothing outside the bounds it is
/// given.
class Layer {
 public:
  explicit Layer(std::string name) : name_(std::move(name)) {}
  virtual ~Layer() = default;
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool enabled() const { return enabled_; }
  /// A disabled layer leaves no trace after the next update.
  void setEnabled(bool enabled) { enabled_ = enabled; }

  /// The master has this geometry from now on; what the layer held for the old one is forgotten or moved.
  virtual void matchSize(const sarn::GridGeometry& geometry) = 0;
  /// Forgets all observations.
  virtual void reset() = 0;
  /// Adds the cells whose cost this layer may change now. Called in order, so later layers see the earlier
  /// bounds.
  virtual void updateBounds(const UpdateContext& context, CellRect& bounds) = 0;
  /// Writes costs inside the bounds, which lie inside the grid.
  virtual void updateCosts(CostGrid& master, const CellRect& bounds) = 0;

 private:
  std::string name_;
  bool enabled_ = true;
};

}  // namespace social_costmap
