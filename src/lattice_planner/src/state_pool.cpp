// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/state_pool.h"

#include <algorithm>
#include <iterator>

namespace lattice_planner {

void StatePool::reset(std::size_t expected) {
  expected_ = expected;
  states_.clear();
  used_ = 0;
  mask_ = kFirstSlots - 1;
  nextEpoch();
}

/// Slots of other epochs are free.
void StatePool::nextEpoch() {
  if (++epoch_ != 0) return;
  for (Slot& slot : slots_) slot.epoch = 0;
  epoch_ = 1;
}

StateId StatePool::find(std::uint64_t key) const {
  const Slot& slot = slots_[slotOf(key)];
  return slot.epoch == epoch_ ? slot.id : kNoState;
}

/// Doubles its memory when it is full, but for no more states than are expected.
StateId StatePool::add(const SearchState& state) {
  if (states_.size() == states_.capacity() && states_.size() < expected_) {
    states_.reserve(std::min(std::max<std::size_t>(2 * states_.capacity(), 1024), expected_));
  }
  states_.push_back(state);
  return static_cast<StateId>(states_.size() - 1);
}

StateId StatePool::put(std::uint64_t key, const SearchState& state) {
  const StateId id = add(state);
  Slot* slot = &slots_[slotOf(key)];
  if (slot->epoch != epoch_ && 2 * ++used_ > mask_) {
    grow();
    slot = &slots_[slotOf(key)];
  }
  *slot = {key, id, epoch_};
  return id;
}

void StatePool::grow() {
  moving_.clear();
  std::copy_if(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(mask_ + 1),
               std::back_inserter(moving_), [this](const Slot& slot) { return slot.epoch == epoch_; });
  mask_ = 2 * mask_ + 1;
  if (slots_.size() <= mask_) slots_.resize(mask_ + 1);
  nextEpoch();
  for (const Slot& slot : moving_) slots_[slotOf(slot.key)] = {slot.key, slot.id, epoch_};
}

std::size_t StatePool::memory() const {
  return states_.capacity() * sizeof(SearchState) + (slots_.capacity() + moving_.capacity()) * sizeof(Slot);
}

}  // namespace lattice_planner
