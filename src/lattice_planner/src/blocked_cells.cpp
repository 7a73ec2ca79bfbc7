// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/blocked_cells.h"

#include <algorithm>

namespace lattice_planner {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

/// row[i] |= row[i - shift] for all bits, towards higher ones.
void orShiftedUp(std::uint64_t* row, std::size_t words, std::size_t shift) {
  const std::size_t whole = shift / 64;
  const std::size_t part = shift % 64;
  for (std::size_t i = words; i-- > whole;) {
    std::uint64_t from = row[i - whole] << part;
    if (part != 0 && i > whole) from |= row[i - whole - 1] >> (64 - part);
    row[i] |= from;
  }
}

void orShiftedDown(std::uint64_t* row, std::size_t words, std::size_t shift) {
  const std::size_t whole = shift / 64;
  const std::size_t part = shift % 64;
  for (std::size_t i = 0; i + whole < words; ++i) {
    std::uint64_t from = row[i + whole] >> part;
    if (part != 0 && i + whole + 1 < words) from |= row[i + whole + 1] << (64 - part);
    row[i] |= from;
  }
}

/// Calls shift(s) with steps that spread by `reach` in all, each as far as what is spread already allows.
template <class Shift>
void doubling(int reach, Shift&& shift) {
  for (int covered = 1; covered < reach + 1;) {
    const int step = std::min(covered, reach + 1 - covered);
    shift(static_cast<std::size_t>(step));
    covered += step;
  }
}

int countBits(std::uint64_t word) { return __builtin_popcountll(word); }

}  // namespace

void BlockedCells::reset(const sarn::GridGeometry& geometry, const std::uint8_t* costs,
                         const std::array<bool, 256>& blocked, int reach) {
  reach_ = reach;
  words_ = (static_cast<std::size_t>(geometry.width + 2 * reach) + 63) / 64;
  rows_ = static_cast<std::size_t>(geometry.height + 2 * reach);
  pack(geometry, costs, blocked);
  near_ = cells_;
  spreadAlongRows();
  spreadAcrossRows();
}

void BlockedCells::pack(const sarn::GridGeometry& geometry, const std::uint8_t* costs,
                        const std::array<bool, 256>& blocked) {
  cells_.assign(rows_ * words_, kAll);
  for (int y = 0; y < geometry.height; ++y) {
    std::uint64_t* const row = cells_.data() + static_cast<std::size_t>(y + reach_) * words_;
    const std::uint8_t* const from =
        costs + static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry.width);
    for (int x = 0; x < geometry.width; ++x) {
      if (blocked[from[x]]) continue;
      const auto column = static_cast<std::size_t>(x + reach_);
      row[column / 64] &= ~(std::uint64_t{1} << (column % 64));
    }
  }
}

void BlockedCells::spreadAlongRows() {
  for (std::size_t y = 0; y < rows_; ++y) {
    std::uint64_t* const row = near_.data() + y * words_;
    doubling(reach_, [&](std::size_t step) { orShiftedUp(row, words_, step); });
    doubling(reach_, [&](std::size_t step) { orShiftedDown(row, words_, step); });
  }
}

void BlockedCells::spreadAcrossRows() {
  const auto or_row = [this](std::size_t to, std::size_t from) {
    for (std::size_t i = 0; i < words_; ++i) near_[to * words_ + i] |= near_[from * words_ + i];
  };
  doubling(reach_, [&](std::size_t step) {
    for (std::size_t y = rows_; y-- > step;) or_row(y, y - step);
  });
  doubling(reach_, [&](std::size_t step) {
    for (std::size_t y = 0; y + step < rows_; ++y) or_row(y, y + step);
  });
}

int BlockedCells::touched(const sarn::CellIndex& cell, const FootprintMasks::Mask& mask, int enough) const {
  int count = 0;
  for (int i = 0; i < mask.count && count < enough; ++i) {
    const auto y = static_cast<std::size_t>(cell.y + mask.first_row + i + reach_);
    const auto first = static_cast<std::size_t>(cell.x + mask.rows[i].first + reach_);
    const auto last = static_cast<std::size_t>(cell.x + mask.rows[i].last + reach_);
    const std::uint64_t* const row = cells_.data() + y * words_;
    const std::size_t last_word = last / 64;
    std::uint64_t wanted = kAll << (first % 64);
    for (std::size_t word = first / 64; word < last_word; ++word) {
      count += countBits(row[word] & wanted);
      wanted = kAll;
    }
    count += countBits(row[last_word] & wanted & kAll >> (63 - last % 64));
  }
  return count;
}

}  // namespace lattice_planner
