// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/inflation_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sarn_common/cost_values.h"

namespace social_costmap {

std::vector<std::string> InflationLayerParams::conflicts() const {
  if (inscribed_radius <= inflation_radius) return {};
  return {"inscribed_radius: is larger than inflation_radius"};
}

std::uint8_t inflationCost(const InflationLayerParams& params, double distance) {
  if (distance <= 0.0) return sarn::kLethalObstacle;
  if (distance > params.inflation_radius) return sarn::kFreeSpace;
  if (distance <= params.inscribed_radius) return sarn::kInscribedObstacle;
  const double beyond = distance - params.inscribed_radius;
  return static_cast<std::uint8_t>((sarn::kInscribedObstacle - 1) *
                                   std::exp(-params.cost_scaling_factor * beyond));
}

InflationLayer::InflationLayer(const InflationLayerParams& params, std::string name)
    : Layer(std::move(name)), params_(params) {
  setEnabled(params.enabled);
}

void InflationLayer::matchSize(const sarn::GridGeometry& geometry) {
  geometry_ = geometry;
  radius_ = static_cast<int>(std::ceil(params_.inflation_radius / geometry.resolution));
  const int reach = radius_ + 1;
  cost_of_.resize(static_cast<std::size_t>(2 * reach * reach) + 1);
  for (std::size_t squared = 0; squared < cost_of_.size(); ++squared) {
    cost_of_[squared] = inflationCost(params_, std::sqrt(static_cast<double>(squared)) * geometry.resolution);
  }
}

void InflationLayer::reset() {}  // holds no observations

void InflationLayer::updateBounds(const UpdateContext&, CellRect& bounds) {
  bounds = bounds.expanded(radius_).clipped(geometry_);
}

// Squared distance to the nearest lethal cell of the same column; (radius + 1)^2 stands for anything farther.
void InflationLayer::measureColumns(const CostGrid& master, const CellRect& window) {
  const auto width = static_cast<std::size_t>(window.width());
  column_.resize(width * static_cast<std::size_t>(window.height()));
  const std::int32_t far = radius_ + 1;
  for (int y = window.min_y; y < window.max_y; ++y) {
    const std::uint8_t* cost = &master.at({window.min_x, y});
    std::int32_t* here = &column_[static_cast<std::size_t>(y - window.min_y) * width];
    for (std::size_t x = 0; x < width; ++x) {
      const std::int32_t below = y > window.min_y ? *(here + x - width) : far;
      here[x] = cost[x] == sarn::kLethalObstacle ? 0 : std::min(far, below + 1);
    }
  }
  for (int y = window.height() - 2; y >= 0; --y) {
    std::int32_t* here = &column_[static_cast<std::size_t>(y) * width];
    for (std::size_t x = 0; x < width; ++x) here[x] = std::min(here[x], here[x + width] + 1);
  }
  for (std::int32_t& distance : column_) distance *= distance;
}

// Squared distance to the nearest lethal cell, for one row of the window: the best column within the radius.
void InflationLayer::measureRow(int row, const CellRect& window) {
  const int width = window.width();
  const std::int32_t* column = &column_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width)];
  row_.assign(column, column + width);
  for (int offset = 1; offset <= std::min(radius_, width - 1); ++offset) {
    const std::int32_t squared = offset * offset;
    std::int32_t* best = row_.data();
    for (int x = 0; x < width - offset; ++x) best[x] = std::min(best[x], column[x + offset] + squared);
    for (int x = offset; x < width; ++x) best[x] = std::min(best[x], column[x - offset] + squared);
  }
}

void InflationLayer::updateCosts(CostGrid& master, const CellRect& bounds) {
  // Cells outside the bounds did not change, but lethal ones among them still inflate into the bounds.
  const CellRect window = bounds.expanded(radius_).clipped(geometry_);
  measureColumns(master, window);
  for (int y = bounds.min_y; y < bounds.max_y; ++y) {
    measureRow(y - window.min_y, window);
    std::uint8_t* cost = &master.at({0, y});
    for (int x = bounds.min_x; x < bounds.max_x; ++x) {
      const std::uint8_t inflated =
          cost_of_[static_cast<std::size_t>(row_[static_cast<std::size_t>(x - window.min_x)])];
      if (cost[x] != sarn::kNoInformation) {
        cost[x] = std::max(cost[x], inflated);
      } else if (inflated >= sarn::kInscribedObstacle ||
                 (params_.inflate_unknown && inflated > sarn::kFreeSpace)) {
        cost[x] = inflated;
      }
    }
  }
}

}  // namespace social_costmap
