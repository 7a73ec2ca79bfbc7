// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sarn_common/map_io.h"
#include "social_costmap/layer.h"

namespace social_costmap {

struct StaticLayerParams {
  bool enabled = true;
  int lethal_cost_threshold = 65;   // occupancy [0, 100] from which a cell is lethal
  bool track_unknown_space = true;  // unknown cells cost 255 (else free)

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("enabled", p.enabled);
    v("lethal_cost_threshold", p.lethal_cost_threshold, {1, 100});
    v("track_unknown_space", p.track_unknown_space);
  }
};

/// Walls and furniture of the map. A master of another geometry than the map is sampled at its cell centres;
/// what lies outside the map is unknown.
class StaticLayer : public Layer {
 public:
  explicit StaticLayer(const StaticLayerParams& params, std::string name = "static");

  void setMap(sarn::OccupancyMap map);
  /// Costs on the master's geometry.
  [[nodiscard]] const CostGrid& costs() const { return costs_; }

  void matchSize(const sarn::GridGeometry& geometry) override;
  void reset() override;  // the map stays
  void updateBounds(const UpdateContext& context, CellRect& bounds) override;
  void updateCosts(CostGrid& master, const CellRect& bounds) override;

 private:
  [[nodiscard]] std::uint8_t cost(std::int8_t occupancy) const;
  void sampleMap();

  StaticLayerParams params_;
  sarn::OccupancyMap map_;
  CostGrid costs_;
  bool changed_ = false;
};

}  // namespace social_costmap
