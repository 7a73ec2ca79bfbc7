// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lattice_planner {

using StateId = std::uint32_t;
inline constexpr StateId kNoState = 0xFFFFFFFFU;

/// A node of the search: the exact state, never changed once made. A cheaper way into the same merge cell
/// makes a new record, so that the poses along a path always follow from each other.
struct SearchState {
  double x = 0.0;         // [m]
  double y = 0.0;         // [m]
  double theta = 0.0;     // [rad] (-pi, pi]
  double g = 0.0;         // cost so far
  float h = 0.0F;         // lower bound of the cost to go
  float estimate = 0.0F;  // what the cost to go will probably be
  StateId parent = kNoState;
  std::uint32_t step = 0;  // [time steps] since the start
  std::uint8_t v = 0;      // index into the lattice's speeds
  std::uint8_t omega = 0;  // likewise
  bool done = false;       // expanded, or superseded by a cheaper record
  bool escaping = false;   // still inside the forbidden area the robot started in

  [[nodiscard]] double f() const { return g + static_cast<double>(h); }
};

/// States of one search, found by merge key. Keeps its memory from search to search, and uses no more of it
/// than the search has grown to: what is looked at at random should stay in the processor's cache.
class StatePool {
 public:
  /// Forgets all states; no more than `expected` will come, or few.
  void reset(std::size_t expected = std::numeric_limits<std::size_t>::max());
  [[nodiscard]] std::size_t size() const { return states_.size(); }
  [[nodiscard]] SearchState& operator[](StateId id) { return states_[id]; }
  [[nodiscard]] const SearchState& operator[](StateId id) const { return states_[id]; }
  /// Has the memory brought that find(key) will read.
  void prefetch(std::uint64_t key) const { __builtin_prefetch(&slots_[mix(key) & mask_]); }
  /// The cheapest record of a merge cell, or kNoState.
  [[nodiscard]] StateId find(std::uint64_t key) const;
  /// Adds a record and makes it the one that the key finds.
  StateId put(std::uint64_t key, const SearchState& state);
  /// Adds a record that no key finds.
  StateId add(const SearchState& state);
  [[nodiscard]] std::size_t memory() const;  // [bytes]

 private:
  struct Slot {
    std::uint64_t key = 0;
    StateId id = kNoState;
    std::uint32_t epoch = 0;
  };
  static constexpr std::size_t kFirstSlots = std::size_t{1} << 13U;  // a power of two
  /// Finalizer of SplitMix64 (Steele, Lea and Flood 2014): spreads neighbouring keys over the table.
  [[nodiscard]] static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }
  [[nodiscard]] std::size_t slotOf(std::uint64_t key) const {
    std::size_t slot = mix(key) & mask_;
    while (slots_[slot].epoch == epoch_ && slots_[slot].key != key) slot = (slot + 1) & mask_;
    return slot;
  }
  void nextEpoch();
  void grow();

  std::vector<SearchState> states_;
  std::vector<Slot> slots_ = std::vector<Slot>(kFirstSlots);
  std::vector<Slot> moving_;            // while the table grows
  std::size_t mask_ = kFirstSlots - 1;  // slots in use, less one
  std::size_t used_ = 0;
  std::size_t expected_ = std::numeric_limits<std::size_t>::max();
  std::uint32_t epoch_ = 1;
};

}  // namespace lattice_planner
