// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sarn_common/parameters.h"
#include "social_costmap/layer.h"

namespace social_costmap {

struct InflationLayerParams {
  bool enabled = true;
  double inscribed_radius = 0.22;    // [m] of the robot (0.18) and a margin for tracking
  double inflation_radius = 0.5;     // [m] no cost beyond
  double cost_scaling_factor = 5.0;  // [1/m]
  bool inflate_unknown = false;      // unknown cells also take costs below inscribed

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("enabled", p.enabled);
    v("inscribed_radius", p.inscribed_radius, {0.0, 2.0});
    v("inflation_radius", p.inflation_radius, {0.0, 5.0});
    v("cost_scaling_factor", p.cost_scaling_factor, {0.0, 100.0});
    v("inflate_unknown", p.inflate_unknown);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Cost at `distance` [m] from the centre of the nearest lethal cell, as costmap_2d defines it: 254 at 0, 253
/// up to the inscribed radius, then 252 exp(-cost_scaling_factor (d - inscribed_radius)), nothing beyond
/// inflation_radius.
[[nodiscard]] std::uint8_t inflationCost(const InflationLayerParams& params, double distance);

/// Costs around lethal cells, so that a planner may treat the robot as a point. Distances are exact (two-pass
/// squared Euclidean transform, Saito and Toriwaki 1994, cut off at the inflation radius) and only computed
/// around the bounds.
class InflationLayer : public Layer {
 public:
  explicit InflationLayer(const InflationLayerParams& params, std::string name = "inflation");

  void matchSize(const sarn::GridGeometry& geometry) override;
  void reset() override;
  void updateBounds(const UpdateContext& context, CellRect& bounds) override;
  void updateCosts(CostGrid& master, const CellRect& bounds) override;

 private:
  void measureColumns(const CostGrid& master, const CellRect& window);
  void measureRow(int row, const CellRect& window);

  InflationLayerParams params_;
  sarn::GridGeometry geometry_;
  int radius_ = 0;                     // [cells] inflation radius, rounded up
  std::vector<std::uint8_t> cost_of_;  // by squared distance [cells^2]
  std::vector<std::int32_t> column_;   // squared distance along the column, window-sized
  std::vector<std::int32_t> row_;      // squared distance, one row of the window
};

}  // namespace social_costmap
