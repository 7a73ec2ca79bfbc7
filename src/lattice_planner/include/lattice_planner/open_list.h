// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lattice_planner/state_pool.h"

namespace lattice_planner {

/// Four-ary min-heap of states by key. Entries are never removed before their turn: the search ignores stale
/// ones.
class OpenList {
 public:
  struct Entry {
    float key;
    float h;  // smaller goes first among equal keys
    StateId id;
  };

  void clear() { heap_.clear(); }
  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }

  void push(const Entry& entry) {
    heap_.push_back(entry);
    siftUp(heap_.size() - 1);
  }

  Entry pop() {
    const Entry top = heap_.front();
    heap_.front() = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) siftDown(0);
    return top;
  }

  template <class Visit>
  void forEach(Visit&& visit) const {
    for (const Entry& entry : heap_) visit(entry);
  }

  /// Gives every entry a new key; entries for which `rekey(entry)` returns false are dropped.
  template <class Rekey>
  void rebuild(Rekey&& rekey) {
    heap_.erase(std::remove_if(heap_.begin(), heap_.end(), [&rekey](Entry& entry) { return !rekey(entry); }),
                heap_.end());
    for (std::size_t i = heap_.size() / 4 + 1; i-- > 0;) {
      if (i < heap_.size()) siftDown(i);
    }
  }

 private:
  static bool before(const Entry& a, const Entry& b) {
    if (a.key != b.key) return a.key < b.key;
    if (a.h != b.h) return a.h < b.h;
    return a.id > b.id;  // the younger first; keeps the order the same everywhere
  }

  void siftUp(std::size_t i) {
    const Entry entry = heap_[i];
    while (i > 0) {
      const std::size_t parent = (i - 1) / 4;
      if (!before(entry, heap_[parent])) break;
      heap_[i] = heap_[parent];
      i = parent;
    }
    heap_[i] = entry;
  }

  void siftDown(std::size_t i) {
    const Entry entry = heap_[i];
    for (;;) {
      const std::size_t first = 4 * i + 1;
      if (first >= heap_.size()) break;
      std::size_t best = first;
      for (std::size_t c = first + 1; c < std::min(first + 4, heap_.size()); ++c) {
        if (before(heap_[c], heap_[best])) best = c;
      }
      if (!before(heap_[best], entry)) break;
      heap_[i] = heap_[best];
      i = best;
    }
    heap_[i] = entry;
  }

  std::vector<Entry> heap_;
};

/// Smallest f of the open states, to within one bucket, by counting: the lower bound of what any plan still
/// costs.
class FrontierBound {
 public:
  /// Buckets of `width` from 0 on.
  void reset(double width) {
    width_ = width;
    counts_.assign(kBuckets, 0);
    first_ = kBuckets - 1;
  }
  void add(double f) {
    const std::size_t bucket = bucketOf(f);
    ++counts_[bucket];
    first_ = std::min(first_, bucket);
  }
  void remove(double f) { --counts_[bucketOf(f)]; }
  /// Not larger than any f that was added and not removed.
  [[nodiscard]] double lowest() {
    while (first_ + 1 < kBuckets && counts_[first_] == 0) ++first_;
    return static_cast<double>(first_) * width_;
  }

 private:
  static constexpr std::size_t kBuckets = 8192;
  [[nodiscard]] std::size_t bucketOf(double f) const {
    return static_cast<std::size_t>(std::clamp(f / width_, 0.0, static_cast<double>(kBuckets - 1)));
  }
  double width_ = 1.0;
  std::size_t first_ = 0;
  std::vector<std::uint32_t> counts_;
};

}  // namespace lattice_planner
