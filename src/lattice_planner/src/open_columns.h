// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lattice_planner/open_list.h"

namespace lattice_planner {

/// Open states in one column a time step, served in turn: the best of each step, then the second best, and so
/// on (anytime column search, Vadlamudi, Gaurav, Aine and Chakrabarti 2012). A guess that is too small all
/// along the way lets one heap look at all early states before the next late one; within a column its error
/// is the same for all, and what is best there comes soon.
class OpenColumns {
 public:
  void clear() {
    for (OpenList& column : columns_) column.clear();
    next_ = 0;
  }
  void push(std::uint32_t step, const OpenList::Entry& entry) {
    if (columns_.size() <= step) columns_.resize(step + 1);
    columns_[step].push(entry);
  }
  [[nodiscard]] bool empty() const {
    for (const OpenList& column : columns_) {
      if (!column.empty()) return false;
    }
    return true;
  }
  /// The best of the next column that has any; there must be one.
  OpenList::Entry pop() {
    for (;; ++next_) {
      if (next_ >= columns_.size()) next_ = 0;
      if (!columns_[next_].empty()) return columns_[next_++].pop();
    }
  }
  template <class Visit>
  void forEach(Visit&& visit) const {
    for (const OpenList& column : columns_) column.forEach(visit);
  }

 private:
  std::vector<OpenList> columns_;  // by step
  std::size_t next_ = 0;
};

}  // namespace lattice_planner
