// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/traversal_map.h"

#include <algorithm>
#include <cstring>

namespace lattice_planner {

bool TraversalMap::update(const sarn::GridGeometry& geometry, const std::uint8_t* costs, const Levels& levels,
                          const std::function<bool(const sarn::CellIndex&)>& exempt) {
  const bool anew = geometry != geometry_ || levels != level_of_ || exempted_ || exempt;
  changed_.clear();
  geometry_ = geometry;
  level_of_ = levels;
  exempted_ = static_cast<bool>(exempt);
  if (anew) {
    costs_.assign(costs, costs + geometry.size());
    levels_.resize(geometry.size());
    thinned_.resize(geometry.size());
    for (int row = 0; row < geometry.height; ++row) levelRow(row, exempt);
    for (int row = 0; row < geometry.height; ++row) {
      thinRow(row);
      std::copy(row_.begin(), row_.end(), thinned_.begin() + static_cast<std::ptrdiff_t>(begin(row)));
    }
    return false;
  }
  const auto width = static_cast<std::size_t>(geometry.width);
  int done = 0;  // rows below are up to date
  for (int row = 0; row < geometry.height; ++row) {
    if (std::memcmp(costs_.data() + begin(row), costs + begin(row), width) == 0) continue;
    int last = row;  // of this block of changed rows
    while (last < geometry.height &&
           std::memcmp(costs_.data() + begin(last), costs + begin(last), width) != 0) {
      std::copy_n(costs + begin(last), width, costs_.begin() + static_cast<std::ptrdiff_t>(begin(last)));
      levelRow(last++, exempt);
    }
    // The row after the block may belong to the next block: it is thinned again then.
    for (int r = std::max(done - 1, std::max(0, row - 1)); r < std::min(geometry.height, last + 1); ++r) {
      replaceRow(r);
    }
    done = last;
    row = last;
  }
  return true;
}

void TraversalMap::levelRow(int row, const std::function<bool(const sarn::CellIndex&)>& exempt) {
  const std::uint8_t* const costs = costs_.data() + begin(row);
  std::uint8_t* const levels = levels_.data() + begin(row);
  for (int x = 0; x < geometry_.width; ++x) {
    levels[x] = level_of_[costs[x]];
    if (exempt && levels[x] == kBlocked && exempt({x, row}))
      levels[x] = std::min<std::uint8_t>(costs[x], 254);
  }
}

void TraversalMap::thinRow(int row) {
  const auto width = static_cast<std::size_t>(geometry_.width);
  const std::uint8_t* const here = levels_.data() + begin(row);
  const std::uint8_t* const below = row > 0 ? levels_.data() + begin(row - 1) : here;
  const std::uint8_t* const above = row + 1 < geometry_.height ? levels_.data() + begin(row + 1) : here;
  column_minimum_.assign(width + 2, kBlocked);
  row_.resize(width);
  std::uint8_t* const least = column_minimum_.data() + 1;
  for (std::size_t x = 0; x < width; ++x) least[x] = std::min(std::min(below[x], here[x]), above[x]);
  for (std::size_t x = 0; x < width; ++x) {
    row_[x] = std::min(std::min(column_minimum_[x], column_minimum_[x + 1]), column_minimum_[x + 2]);
  }
}

void TraversalMap::replaceRow(int row) {
  thinRow(row);
  for (std::size_t x = 0; x < row_.size(); ++x) {
    if (thinned_[begin(row) + x] == row_[x]) continue;
    thinned_[begin(row) + x] = row_[x];
    changed_.push_back(static_cast<std::uint32_t>(begin(row) + x));
  }
}

}  // namespace lattice_planner
