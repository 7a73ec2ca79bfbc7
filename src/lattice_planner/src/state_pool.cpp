// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/state_pool.h"

#include <utility>

namespace lattice_planner {
namespace {

/// Finalizer of SplitMix64 (Steele, Lea and Flood 2014): spreads neighbouring keys over the table.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

}  // namespace

void StatePool::reset() {
  states_.clear();
  used_ = 0;
  if (++epoch_ != 0) return;
  for (Slot& slot : slots_) slot.epoch = 0;
  epoch_ = 1;
}

std::size_t StatePool::slotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = mix(key) & mask;
  while (slots_[slot].epoch == epoch_ && slots_[slot].key != key) slot = (slot + 1) & mask;
  return slot;
}

StateId StatePool::find(std::uint64_t key) const {
  const Slot& slot = slots_[slotOf(key)];
  return slot.epoch == epoch_ ? slot.id : kNoState;
}

StateId StatePool::add(const SearchState& state) {
  states_.push_back(state);
  return static_cast<StateId>(states_.size() - 1);
}

StateId StatePool::put(std::uint64_t key, const SearchState& state) {
  const StateId id = add(state);
  Slot* slot = &slots_[slotOf(key)];
  if (slot->epoch != epoch_) {
    if (2 * ++used_ > slots_.size()) {
      grow();
      slot = &slots_[slotOf(key)];
    }
  }
  *slot = {key, id, epoch_};
  return id;
}

void StatePool::grow() {
  std::vector<Slot> old(2 * slots_.size());
  std::swap(old, slots_);
  for (const Slot& slot : old) {
    if (slot.epoch == epoch_) slots_[slotOf(slot.key)] = slot;
  }
}

std::size_t StatePool::memory() const {
  return states_.capacity() * sizeof(SearchState) + slots_.capacity() * sizeof(Slot);
}

}  // namespace lattice_planner
