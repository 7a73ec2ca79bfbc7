// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "lattice_planner/planner_params.h"

namespace lattice_planner {

/// How long a search goes on, and how greedily: its limits of time, work and memory, and the weight of the
/// guess, which falls to 1 with each better plan and rises while there is none.
class SearchEffort {
 public:
  using Clock = std::chrono::steady_clock;
  explicit SearchEffort(const PlannerParams& params) : params_(params) {}

  /// `stop`: true ends the search before the deadline; empty: nothing does.
  void begin(Clock::time_point deadline, std::function<bool()> stop);
  void countExpansion() { ++expansions_; }
  void countSuccessor() { ++generated_; }
  [[nodiscard]] std::size_t expansions() const { return expansions_; }
  [[nodiscard]] std::size_t generated() const { return generated_; }
  [[nodiscard]] double weight() const { return weight_; }

  [[nodiscard]] bool beforeDeadline() const { return Clock::now() < deadline_ && !(stop_ && stop_()); }
  /// True when a limit is reached with this many states in memory.
  [[nodiscard]] bool spent(std::size_t states) const;
  /// True when as much was done after the first plan as improving it is worth.
  [[nodiscard]] bool improvedEnough() const {
    return enough_expansions_ > 0 && expansions_ >= enough_expansions_;
  }
  /// After that, whether to go on none the less: `guess` is what the plan may come down to, as a share of its
  /// cost. Where that is much less, the search goes on until it is little less, within limits.
  [[nodiscard]] bool goesOn(double guess);
  /// A plan is in hand: the weight falls, so that the bound can be proved.
  void planFound(bool first);
  /// Without a plan after much work: true, with a larger weight, each time the work has doubled.
  [[nodiscard]] bool hurries();

 private:
  const PlannerParams& params_;
  Clock::time_point deadline_;
  std::function<bool()> stop_;
  double weight_ = 1.0;
  std::size_t expansions_ = 0;
  std::size_t generated_ = 0;          // successors looked at
  std::size_t enough_expansions_ = 0;  // 0: no limit
  std::size_t most_expansions_ = 0;    // of a search that goes on; 0: it does not yet
  std::size_t hurry_at_ = 0;           // [expansions] 0: never
};

}  // namespace lattice_planner
