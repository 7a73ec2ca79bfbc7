// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "search_task.h"

namespace lattice_planner {

/// The static layer and the people who stay where the time layers end, as one map of costs: what a robot that
/// comes later finds.
class CrowdedMap {
 public:
  explicit CrowdedMap(const SearchTask& task);

  /// For the task's present request. False: nobody stays.
  bool reset();
  [[nodiscard]] const std::uint8_t* costs() const { return costs_.data(); }
  [[nodiscard]] const std::array<bool, 256>& blocked() const { return blocked_; }
  [[nodiscard]] const std::array<float, 256>& perMetre() const { return per_metre_; }

 private:
  [[nodiscard]] std::uint8_t levelOf(std::uint8_t static_cost, std::uint8_t social_cost) const;

  const SearchTask& task_;
  std::vector<std::uint8_t> costs_;
  std::array<std::uint8_t, 256> static_levels_{};
  std::array<bool, 256> blocked_{};     // by level
  std::array<float, 256> per_metre_{};  // least cost of one metre, by level
  float level_per_rate_ = 1.0F;
};

}  // namespace lattice_planner
