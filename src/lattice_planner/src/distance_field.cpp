// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lattice_planner {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBuckets = 64;
/// Largest ratio of 16-connected to Euclidean distance: halfway (in slope) between the moves (1, 0) and (2,
/// 1), 1 / cos(atan(1/2) / 2).
constexpr float kDetour = 1.02749F;
constexpr float kEndSlackCells = 1.5F;

}  // namespace

void DistanceField::buildMoves() {
  const std::ptrdiff_t width = task_.geometry.width;
  moves_.clear();
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const int far = std::max(std::abs(dx), std::abs(dy));
      if (far == 0 || (far == 2 && std::min(std::abs(dx), std::abs(dy)) != 1)) continue;
      Move move{dx, dy, static_cast<float>(std::hypot(dx, dy)), {0, 0}, {0, 0}, dy * width + dx, {0, 0}};
      if (far == 2) {
        const bool along_x = std::abs(dx) == 2;
        move.via_x[0] = along_x ? dx / 2 : 0;
        move.via_y[0] = along_x ? 0 : dy / 2;
        move.via_x[1] = along_x ? dx / 2 : dx;
        move.via_y[1] = along_x ? dy : dy / 2;
        for (int i : {0, 1}) move.via[i] = move.via_y[i] * width + move.via_x[i];
      }
      moves_.push_back(move);
    }
  }
}

void DistanceField::reset(DistanceFieldTask task) {
  constexpr Cell kFresh{kInfinity, -1.0F, 0};
  if (cells_.size() == task.geometry.size()) {
    for (const std::uint32_t cell : touched_) cells_[cell] = kFresh;
  } else {
    cells_.assign(task.geometry.size(), kFresh);
  }
  touched_.clear();
  buckets_.resize(kBuckets);
  for (auto& bucket : buckets_) bucket.clear();
  first_bucket_ = 0;
  first_number_ = 0;
  pending_ = settled_ = 0;
  task_ = std::move(task);
  buildMoves();
  const float resolution = static_cast<float>(task_.geometry.resolution);
  bucket_width_ = *std::min_element(task_.rate->begin(), task_.rate->end()) * resolution;
  buckets_per_cost_ = 1.0F / bucket_width_;
  end_slack_ = kEndSlackCells * bucket_width_;
  const double reach = task_.floor_radius;
  floor_low_ = task_.geometry.cellAtUnbounded(task_.goal_x - reach, task_.goal_y - reach);
  floor_high_ = task_.geometry.cellAtUnbounded(task_.goal_x + reach, task_.goal_y + reach);
  seed();
}

void DistanceField::seed() {
  const double reach = task_.goal_radius + 1.5 * task_.geometry.resolution;
  const int cells = static_cast<int>(std::ceil(reach / task_.geometry.resolution)) + 1;
  const sarn::CellIndex center = task_.geometry.cellAtUnbounded(task_.goal_x, task_.goal_y);
  for (int y = center.y - cells; y <= center.y + cells; ++y) {
    for (int x = center.x - cells; x <= center.x + cells; ++x) {
      const sarn::CellIndex cell{x, y};
      if (!task_.geometry.contains(cell)) continue;
      const Eigen::Vector2d p = task_.geometry.center(cell);
      if (std::hypot(p.x() - task_.goal_x, p.y() - task_.goal_y) > reach) continue;
      const auto index = static_cast<std::uint32_t>(task_.geometry.index(cell));
      if (rate(cell, index) == kInfinity) continue;
      cells_[index].label = 0.0F;
      push(0.0F, index);
    }
  }
}

float DistanceField::rate(const sarn::CellIndex& cell, std::uint32_t index) {
  float& known = cells_[index].rate;
  if (known < 0.0F) {
    known = computeRate(cell);
    touched_.push_back(index);
  }
  return known;
}

float DistanceField::computeRate(const sarn::CellIndex& cell) {
  float best = kInfinity;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const sarn::CellIndex near{cell.x + dx, cell.y + dy};
      if (!task_.geometry.contains(near)) continue;
      const std::uint8_t cost = task_.costs[task_.geometry.index(near)];
      if ((*task_.blocked)[cost] && !(task_.exempt && task_.exempt(near))) continue;
      best = std::min(best, (*task_.rate)[cost]);
    }
  }
  return best * static_cast<float>(task_.geometry.resolution);
}

void DistanceField::push(float key, std::uint32_t cell) {
  const auto number = static_cast<std::uint64_t>(key * buckets_per_cost_);
  const std::uint64_t offset = number > first_number_ ? number - first_number_ : 0;
  const std::size_t slot = (first_bucket_ + std::min<std::uint64_t>(offset, kBuckets - 1)) % kBuckets;
  buckets_[slot].push_back({key, cell});
  ++pending_;
}

bool DistanceField::advanceOneBucket() {
  if (pending_ == 0) return false;
  while (buckets_[first_bucket_].empty()) {
    first_bucket_ = (first_bucket_ + 1) % kBuckets;
    ++first_number_;
  }
  auto& bucket = buckets_[first_bucket_];
  for (std::size_t i = 0; i < bucket.size(); ++i) {  // grows while it is read
    const Entry entry = bucket[i];
    --pending_;
    Cell& cell = cells_[entry.cell];
    if (cell.settled != 0 || entry.key > cell.label) continue;
    if (static_cast<std::uint64_t>(entry.key * buckets_per_cost_) >
        first_number_) {  // did not fit into the ring
      push(entry.key, entry.cell);
      continue;
    }
    cell.settled = 1;
    ++settled_;
    relaxNeighbours(entry.cell);
  }
  bucket.clear();
  first_bucket_ = (first_bucket_ + 1) % kBuckets;
  ++first_number_;
  return true;
}

void DistanceField::relaxNeighbours(std::uint32_t index) {
  const auto width = static_cast<std::uint32_t>(task_.geometry.width);
  const sarn::CellIndex cell{static_cast<int>(index % width), static_cast<int>(index / width)};
  const bool interior =
      cell.x >= 2 && cell.y >= 2 && cell.x < task_.geometry.width - 2 && cell.y < task_.geometry.height - 2;
  if (interior) {
    relaxNeighboursOf<true>(cell, index);
  } else {
    relaxNeighboursOf<false>(cell, index);
  }
}

template <bool kInterior>
void DistanceField::relaxNeighboursOf(const sarn::CellIndex& cell, std::uint32_t index) {
  const float cost = cells_[index].label;
  const float own_rate = cells_[index].rate;
  for (const Move& move : moves_) {
    const sarn::CellIndex to{cell.x + move.dx, cell.y + move.dy};
    if (!kInterior && !task_.geometry.contains(to)) continue;
    const auto target = static_cast<std::uint32_t>(index + move.offset);
    // No move costs less than with the target's rate at zero: most known cells need no closer look.
    if (cells_[target].label <= cost + move.length * 0.5F * (own_rate + bucket_width_)) continue;
    const float next_rate = rate(to, target);
    if (next_rate == kInfinity) continue;
    float label = cost + 0.5F * move.length * (own_rate + next_rate);
    if (label >= cells_[target].label) continue;
    if (move.length > 2.0F) {
      const float via = std::min(rate({cell.x + move.via_x[0], cell.y + move.via_y[0]},
                                      static_cast<std::uint32_t>(index + move.via[0])),
                                 rate({cell.x + move.via_x[1], cell.y + move.via_y[1]},
                                      static_cast<std::uint32_t>(index + move.via[1])));
      if (via == kInfinity) continue;
    }
    if (to.x >= floor_low_.x && to.y >= floor_low_.y && to.x <= floor_high_.x && to.y <= floor_high_.y &&
        task_.floor) {
      const float floor = task_.floor(to);
      if (floor > 0.0F) label = std::max(label, (floor + end_slack_) * kDetour);
      if (label >= cells_[target].label) continue;
    }
    cells_[target].label = label;
    push(label, target);
  }
}

float DistanceField::lowerBound(float label) const { return std::max(0.0F, label / kDetour - end_slack_); }

float DistanceField::at(const sarn::CellIndex& cell) {
  const std::size_t index = task_.geometry.index(cell);
  unsigned turns = 0;
  while (cells_[index].settled == 0) {
    if ((++turns & 15U) == 0 && keep_going_ && !keep_going_()) {
      return lowerBound(static_cast<float>(first_number_) * bucket_width_);
    }
    if (!advanceOneBucket()) return kInfinity;
  }
  return lowerBound(cells_[index].label);
}

void DistanceField::computeTo(float bound) {
  unsigned turns = 0;
  while (lowerBound(static_cast<float>(first_number_) * bucket_width_) < bound) {
    if ((++turns & 15U) == 0 && keep_going_ && !keep_going_()) return;
    if (!advanceOneBucket()) return;
  }
}

float DistanceField::known(const sarn::CellIndex& cell) const {
  const Cell& c = cells_[task_.geometry.index(cell)];
  return c.settled != 0 ? lowerBound(c.label) : kInfinity;
}

}  // namespace lattice_planner
