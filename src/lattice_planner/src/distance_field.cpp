// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lattice_planner {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBuckets = 128;  // a power of two
/// Largest ratio of 16-connected to Euclidean distance: halfway (in slope) between the moves (1, 0) and (2,
/// 1), 1 / cos(atan(1/2) / 2).
constexpr float kDetour = 1.02749F;
constexpr float kEndSlackCells = 1.5F;
constexpr float kRootTwo = 1.41421356F;
constexpr float kRootFive = 2.23606798F;
constexpr int kChangeReach = 3;  // [cells] around a changed cell whose labels may be wrong

/// 16-connected distance [cells]: the fewest cells' lengths of moves (1, 0), (1, 1) and (2, 1).
float gridDistance(int dx, int dy) {
  const auto x = static_cast<float>(std::abs(dx));
  const auto y = static_cast<float>(std::abs(dy));
  const float far = std::max(x, y);
  const float near = std::min(x, y);
  return 2.0F * near <= far ? far + (kRootFive - 2.0F) * near
                            : (kRootFive - kRootTwo) * far + (2.0F * kRootTwo - kRootFive) * near;
}

/// What a cost counts as, so that dearer is larger and blocked is largest.
TraversalMap::Levels levelsOf(const DistanceFieldTask& task) {
  TraversalMap::Levels levels{};
  for (std::size_t cost = 0; cost < 256; ++cost) {
    std::size_t level = std::min<std::size_t>(cost, 254);
    if (cost == 255) {  // unknown: the largest known cost that is no dearer
      while (level > 0 && (*task.rate)[level] > (*task.rate)[cost]) --level;
    }
    levels[cost] = (*task.blocked)[cost] ? TraversalMap::kBlocked : static_cast<std::uint8_t>(level);
  }
  return levels;
}

}  // namespace

bool DistanceField::sameTask(const DistanceFieldTask& task) const {
  return task.geometry == task_.geometry && task.blocked == task_.blocked && task.rate == task_.rate &&
         task.goal_x == task_.goal_x && task.goal_y == task_.goal_y &&
         task.goal_radius == task_.goal_radius && task.floor_radius == task_.floor_radius &&
         task.floor_id == task_.floor_id;
}

void DistanceField::reset(const DistanceFieldTask& task) {
  const bool same = sameTask(task) && !labels_.empty();
  task_ = task;
  start_ = task_.geometry.cellAtUnbounded(task_.start_x, task_.start_y);
  settled_count_ = 0;
  const bool map_kept = map_.update(task_.geometry, task_.costs, levelsOf(task_), task_.exempt);
  if (!same) layOut();
  if (!same || !map_kept) {
    clear();
    seed();
    return;
  }
  float lowest_changed = kInfinity;
  for (const std::uint32_t index : map_.changed()) {
    const sarn::CellIndex cell = cellOf(index);
    for (int y = cell.y - kChangeReach; y <= cell.y + kChangeReach; ++y) {
      for (int x = cell.x - kChangeReach; x <= cell.x + kChangeReach; ++x) {
        if (!task_.geometry.contains({x, y})) continue;
        lowest_changed = std::min(lowest_changed, labels_[task_.geometry.index({x, y})]);
      }
    }
  }
  keepLabelsBelow(lowest_changed);
  seed();
}

void DistanceField::layOut() {
  buildMoves();
  const float resolution = static_cast<float>(task_.geometry.resolution);
  for (std::size_t cost = 0; cost < 255; ++cost) half_rate_[cost] = 0.5F * resolution * (*task_.rate)[cost];
  half_rate_[TraversalMap::kBlocked] = kInfinity;
  cheapest_step_ = 2.0F * *std::min_element(half_rate_.begin(), half_rate_.end());
  bucket_width_ = 0.5F * cheapest_step_;
  buckets_per_cost_ = 1.0F / bucket_width_;
  end_slack_ = kEndSlackCells * cheapest_step_;
  const double reach = task_.floor_radius;
  floor_low_ = task_.geometry.cellAtUnbounded(task_.goal_x - reach, task_.goal_y - reach);
  floor_high_ = task_.geometry.cellAtUnbounded(task_.goal_x + reach, task_.goal_y + reach);
}

void DistanceField::buildMoves() {
  const std::ptrdiff_t width = task_.geometry.width;
  moves_.clear();
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const int far = std::max(std::abs(dx), std::abs(dy));
      if (far == 0 || (far == 2 && std::min(std::abs(dx), std::abs(dy)) != 1)) continue;
      Move move{dx, dy, static_cast<float>(std::hypot(dx, dy)), dy * width + dx, {0, 0}};
      if (far == 2) {
        const bool along_x = std::abs(dx) == 2;
        move.via[0] = along_x ? dx / 2 : dy / 2 * width;
        move.via[1] = along_x ? dy * width + dx / 2 : dy / 2 * width + dx;
      }
      moves_.push_back(move);
    }
  }
}

void DistanceField::clear() {
  if (labels_.size() != task_.geometry.size()) {
    labels_.assign(task_.geometry.size(), kInfinity);
    settled_.assign(task_.geometry.size(), 0);
  } else if (first_row_ <= last_row_) {
    const auto width = static_cast<std::ptrdiff_t>(task_.geometry.width);
    std::fill(labels_.begin() + first_row_ * width, labels_.begin() + (last_row_ + 1) * width, kInfinity);
    std::fill(settled_.begin() + first_row_ * width, settled_.begin() + (last_row_ + 1) * width,
              std::uint8_t{0});
  }
  first_row_ = task_.geometry.height;
  last_row_ = -1;
  forgetQueue();
}

void DistanceField::forgetQueue() {
  buckets_.resize(kBuckets);
  for (auto& bucket : buckets_) bucket.clear();
  first_bucket_ = 0;
  first_number_ = 0;
  pending_ = reused_ = 0;
}

/// Begins the wave at the goal, and at the border of what is known, in the order of the start.
void DistanceField::seed() {
  collectBorder();
  const std::size_t known = border_.size();
  collectGoal();
  float least_key = kInfinity;
  for (const sarn::CellIndex& cell : border_) {
    least_key = std::min(least_key, keyOf(labels_[task_.geometry.index(cell)], cell));
  }
  if (border_.empty()) return;
  first_number_ = static_cast<std::int64_t>(least_key * buckets_per_cost_);
  for (std::size_t i = known; i < border_.size(); ++i) push(0.0F, border_[i]);
  for (std::size_t i = 0; i < known; ++i) {
    relaxNeighbours(border_[i], static_cast<std::uint32_t>(task_.geometry.index(border_[i])));
  }
}

/// Cells that touch the goal and are not known yet; their labels are 0.
void DistanceField::collectGoal() {
  const double reach = task_.goal_radius + 1.5 * task_.geometry.resolution;
  const int cells = static_cast<int>(std::ceil(reach / task_.geometry.resolution)) + 1;
  const sarn::CellIndex center = task_.geometry.cellAtUnbounded(task_.goal_x, task_.goal_y);
  for (int y = center.y - cells; y <= center.y + cells; ++y) {
    for (int x = center.x - cells; x <= center.x + cells; ++x) {
      const sarn::CellIndex cell{x, y};
      if (!task_.geometry.contains(cell)) continue;
      const Eigen::Vector2d p = task_.geometry.center(cell);
      if (std::hypot(p.x() - task_.goal_x, p.y() - task_.goal_y) > reach) continue;
      const std::size_t index = task_.geometry.index(cell);
      if (settled_[index] != 0 || map_.thinned()[index] == TraversalMap::kBlocked) continue;
      labels_[index] = 0.0F;
      border_.push_back(cell);
    }
  }
}

/// Whatever lies nearer to the goal than every changed cell is not touched by the change.
void DistanceField::keepLabelsBelow(float label) {
  forgetQueue();
  if (first_row_ > last_row_) return;
  const auto width = static_cast<std::size_t>(task_.geometry.width);
  for (std::size_t i = static_cast<std::size_t>(first_row_) * width;
       i < static_cast<std::size_t>(last_row_ + 1) * width; ++i) {
    if (settled_[i] != 0 && labels_[i] < label) {
      ++reused_;
    } else {
      settled_[i] = 0;
      labels_[i] = kInfinity;
    }
  }
}

/// Known cells with a neighbour that is not.
void DistanceField::collectBorder() {
  border_.clear();
  if (first_row_ > last_row_) return;
  const auto width = static_cast<std::size_t>(task_.geometry.width);
  for (std::size_t i = static_cast<std::size_t>(first_row_) * width;
       i < static_cast<std::size_t>(last_row_ + 1) * width; ++i) {
    if (settled_[i] == 0) continue;
    const sarn::CellIndex cell = cellOf(static_cast<std::uint32_t>(i));
    const bool inner = std::all_of(moves_.begin(), moves_.end(), [&](const Move& move) {
      return !task_.geometry.contains({cell.x + move.dx, cell.y + move.dy}) ||
             settled_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + move.offset)] != 0;
    });
    if (!inner) border_.push_back(cell);
  }
}

sarn::CellIndex DistanceField::cellOf(std::uint32_t index) const {
  const auto width = static_cast<std::uint32_t>(task_.geometry.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

/// A* towards the start: consistent, as no move is cheaper than its length at the smallest rate.
float DistanceField::keyOf(float label, const sarn::CellIndex& cell) const {
  return label + cheapest_step_ * gridDistance(cell.x - start_.x, cell.y - start_.y);
}

void DistanceField::push(float label, const sarn::CellIndex& cell) {
  const auto number = static_cast<std::int64_t>(keyOf(label, cell) * buckets_per_cost_);
  const auto offset = std::clamp<std::int64_t>(number - first_number_, 0, kBuckets - 1);
  buckets_[(first_bucket_ + static_cast<std::size_t>(offset)) % kBuckets].push_back(
      {label, cell, static_cast<std::int32_t>(number)});
  first_row_ = std::min(first_row_, cell.y);
  last_row_ = std::max(last_row_, cell.y);
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
    const auto index = static_cast<std::uint32_t>(task_.geometry.index(entry.cell));
    if (entry.label > labels_[index]) continue;
    if (entry.number > first_number_) {
      push(entry.label, entry.cell);  // it did not fit into the ring
      continue;
    }
    settle(index);
    relaxNeighbours(entry.cell, index);
  }
  bucket.clear();
  first_bucket_ = (first_bucket_ + 1) % kBuckets;
  ++first_number_;
  return true;
}

/// A label may still fall until its bucket is empty: questions are answered between buckets only.
void DistanceField::settle(std::uint32_t index) {
  if (settled_[index] == 0) ++settled_count_;
  settled_[index] = 1;
}

void DistanceField::relaxNeighbours(const sarn::CellIndex& cell, std::uint32_t index) {
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
  const std::uint8_t* const costs = map_.thinned().data();
  const float label_here = labels_[index];
  const float own_rate = half_rate_[costs[index]];
  const float least_rate = own_rate + 0.5F * cheapest_step_;
  for (const Move& move : moves_) {
    const sarn::CellIndex to{cell.x + move.dx, cell.y + move.dy};
    if (!kInterior && !task_.geometry.contains(to)) continue;
    const auto target = static_cast<std::uint32_t>(index + move.offset);
    // Most known cells need no closer look.
    if (labels_[target] <= label_here + move.length * least_rate) continue;
    float label = label_here + move.length * (own_rate + half_rate_[costs[target]]);
    if (label >= labels_[target]) continue;
    if (move.length > 2.0F && costs[index + move.via[0]] == TraversalMap::kBlocked &&
        costs[index + move.via[1]] == TraversalMap::kBlocked) {
      continue;
    }
    if (to.x >= floor_low_.x && to.y >= floor_low_.y && to.x <= floor_high_.x && to.y <= floor_high_.y &&
        task_.floor) {
      const float floor = task_.floor(to);
      if (floor > 0.0F) label = std::max(label, (floor + end_slack_) * kDetour);
      if (label >= labels_[target]) continue;
    }
    labels_[target] = label;
    push(label, to);
  }
}

float DistanceField::lowerBound(float label) const { return std::max(0.0F, label / kDetour - end_slack_); }

/// No cell that is not known has a smaller label.
float DistanceField::frontLabel(const sarn::CellIndex& cell) const {
  return static_cast<float>(first_number_) * bucket_width_ - keyOf(0.0F, cell);
}

float DistanceField::at(const sarn::CellIndex& cell) {
  const std::size_t index = task_.geometry.index(cell);
  unsigned turns = 0;
  while (settled_[index] == 0) {
    if ((++turns & 15U) == 0 && keep_going_ && !keep_going_()) return lowerBound(frontLabel(cell));
    if (!advanceOneBucket()) return kInfinity;
  }
  return lowerBound(labels_[index]);
}

DistanceField::Guess DistanceField::guess(double x, double y) {
  const sarn::GridGeometry& g = task_.geometry;
  const sarn::CellIndex cell = g.cellAtUnbounded(x, y);
  if (at(cell) == kInfinity) return {kInfinity, 0.0F, 0.0F};
  const double column = (x - g.origin_x) / g.resolution - 0.5;
  const double row = (y - g.origin_y) / g.resolution - 0.5;
  const sarn::CellIndex low{column < cell.x ? cell.x - 1 : cell.x, row < cell.y ? cell.y - 1 : cell.y};
  const float here = labels_[g.index(cell)];
  if (low.x < 0 || low.y < 0 || low.x + 1 >= g.width || low.y + 1 >= g.height) {
    return {task_.guess_scale * here, 0.0F, 0.0F};
  }
  const float* const c = labels_.data() + g.index(low);
  const float c00 = c[0], c10 = c[1], c01 = c[g.width], c11 = c[g.width + 1];
  if (std::max(std::max(c00, c10), std::max(c01, c11)) == kInfinity)
    return {task_.guess_scale * here, 0.0F, 0.0F};
  const auto fx = static_cast<float>(column - low.x);
  const auto fy = static_cast<float>(row - low.y);
  const float bottom = c00 + fx * (c10 - c00);
  const float top = c01 + fx * (c11 - c01);
  const auto per_cell = static_cast<float>(1.0 / g.resolution);
  return {task_.guess_scale * (bottom + fy * (top - bottom)),
          ((1.0F - fy) * (c10 - c00) + fy * (c11 - c01)) * per_cell, (top - bottom) * per_cell};
}

void DistanceField::computeDetours(float extra) {
  const float start = at(start_);
  if (start == kInfinity) return;
  const float until = labels_[task_.geometry.index(start_)] + extra;
  unsigned turns = 0;
  while (static_cast<float>(first_number_) * bucket_width_ < until) {
    if ((++turns & 15U) == 0 && keep_going_ && !keep_going_()) return;
    if (!advanceOneBucket()) return;
  }
}

float DistanceField::known(const sarn::CellIndex& cell) const {
  const std::size_t index = task_.geometry.index(cell);
  return settled_[index] != 0 ? lowerBound(labels_[index]) : kInfinity;
}

float DistanceField::knownGuess(const sarn::CellIndex& cell) const {
  const std::size_t index = task_.geometry.index(cell);
  return settled_[index] != 0 ? task_.guess_scale * labels_[index] : kInfinity;
}

}  // namespace lattice_planner
