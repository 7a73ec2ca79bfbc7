// SPDX-License-Identifier: BSD-3-Clause
#include "crowded_map.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace lattice_planner {
namespace {

constexpr std::size_t kBlocked = 253;  // level of what is forbidden; below it levels are in proportion

}  // namespace

CrowdedMap::CrowdedMap(const SearchTask& task) : task_(task) {
  const CellCosts& costs = task.cell_costs;
  const float dearest_static = *std::max_element(costs.static_rate.begin(), costs.static_rate.end());
  const float dearest_social = *std::max_element(costs.social_rate.begin(), costs.social_rate.end());
  const float dearest = task.params.combine_with_max ? std::max(dearest_static, dearest_social)
                                                     : dearest_static + dearest_social;
  level_per_rate_ = dearest > 0.0F ? static_cast<float>(kBlocked - 1) / dearest : 0.0F;
  for (std::size_t level = 0; level < 256; ++level) {
    blocked_[level] = level >= kBlocked;
    const float rate = level_per_rate_ > 0.0F ? static_cast<float>(level) / level_per_rate_ : 0.0F;
    per_metre_[level] =
        static_cast<float>(task.lattice.costPerMetre()) + rate / static_cast<float>(task.lattice.maxSpeed());
    static_levels_[level] = levelOf(static_cast<std::uint8_t>(level), 0);
  }
}

std::uint8_t CrowdedMap::levelOf(std::uint8_t static_cost, std::uint8_t social_cost) const {
  const CellCosts& costs = task_.cell_costs;
  if (costs.forbidden_static[static_cost] || costs.forbidden_social[social_cost]) return kBlocked;
  const float a = costs.static_rate[static_cost];
  const float b = costs.social_rate[social_cost];
  const float rate = task_.params.combine_with_max ? std::max(a, b) : a + b;
  return static_cast<std::uint8_t>(std::min(rate * level_per_rate_, static_cast<float>(kBlocked - 1)));
}

bool CrowdedMap::reset() {
  const int last = task_.time.lastLayer();
  if (last < 0) return false;
  const std::uint8_t* const people = task_.costmap.layers[static_cast<std::size_t>(last)];
  const std::size_t size = task_.costmap.geometry.size();
  if (people[0] == 0 && std::memcmp(people, people + 1, size - 1) == 0) return false;
  costs_.resize(size);
  const std::uint8_t* const walls = task_.costmap.static_costs;
  for (std::size_t i = 0; i < size; ++i) {
    costs_[i] = people[i] == 0 ? static_levels_[walls[i]] : levelOf(walls[i], people[i]);
  }
  return true;
}

}  // namespace lattice_planner
