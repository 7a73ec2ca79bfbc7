// SPDX-License-Identifier: BSD-3-Clause
#include "fine_costmap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lattice_planner {
namespace {

constexpr double kMostParts = 20.0;  // cells larger than a few robots are no map for it anyway
constexpr double kMostCells = 4e6;   // of a layer, once cut

/// Each cell becomes parts x parts.
void cut(const sarn::GridGeometry& coarse, const std::uint8_t* costs, int parts,
         std::vector<std::uint8_t>& fine) {
  const auto width = static_cast<std::size_t>(coarse.width);
  const std::size_t fine_width = width * static_cast<std::size_t>(parts);
  fine.resize(coarse.size() * static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts));
  std::uint8_t* out = fine.data();
  for (int y = 0; y < coarse.height; ++y) {
    const std::uint8_t* const row = costs + static_cast<std::size_t>(y) * width;
    std::uint8_t* const first = out;
    for (std::size_t x = 0; x < width; ++x) out = std::fill_n(out, parts, row[x]);
    for (int copy = 1; copy < parts; ++copy) out = std::copy_n(first, fine_width, out);
  }
}

}  // namespace

sarn::TimedCostmapView FineCostmap::of(const sarn::TimedCostmapView& costmap, double largest) {
  const double wanted = std::ceil(costmap.geometry.resolution / largest - 1e-6);
  const double most = std::floor(std::sqrt(kMostCells / static_cast<double>(costmap.geometry.size())));
  const int parts = static_cast<int>(std::min({wanted, most, kMostParts}));
  if (parts <= 1) return costmap;
  sarn::TimedCostmapView view = costmap;
  view.geometry.width *= parts;
  view.geometry.height *= parts;
  view.geometry.resolution /= parts;
  layers_.resize(std::max(layers_.size(), costmap.layers.size() + 1));
  cut(costmap.geometry, costmap.static_costs, parts, layers_[0]);
  view.static_costs = layers_[0].data();
  for (std::size_t i = 0; i < costmap.layers.size(); ++i) {
    cut(costmap.geometry, costmap.layers[i], parts, layers_[i + 1]);
    view.layers[i] = layers_[i + 1].data();
  }
  return view;
}

}  // namespace lattice_planner
