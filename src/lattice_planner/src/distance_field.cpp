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

struct Move {
  int dx;
  int dy;
  float length;  // [cells]
  int via_x[2];  // cells a knight's move passes between
  int via_y[2];
};

std::vector<Move> makeMoves() {
  std::vector<Move> moves;
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const int far = std::max(std::abs(dx), std::abs(dy));
      if (far == 0 || (far == 2 && std::min(std::abs(dx), std::abs(dy)) != 1)) continue;
      Move move{dx, dy, static_cast<float>(std::hypot(dx, dy)), {0, 0}, {0, 0}};
      if (far == 2) {
        const bool along_x = std::abs(dx) == 2;
        move.via_x[0] = along_x ? dx / 2 : 0;
        move.via_y[0] = along_x ? 0 : dy / 2;
        move.via_x[1] = along_x ? dx / 2 : dx;
        move.via_y[1] = along_x ? dy : dy / 2;
      }
      moves.push_back(move);
    }
  }
  return moves;
}

const std::vector<Move>& moves() {
  static const std::vector<Move> all = makeMoves();
  return all;
}

}  // namespace

void DistanceField::reset(DistanceFieldTask task) {
  const std::size_t size = task.geometry.size();
  if (label_.size() == size) {
    for (const std::uint32_t cell : touched_) {
      label_[cell] = kInfinity;
      state_[cell] = kUntouched;
      rate_cache_[cell] = -1.0F;
    }
  } else {
    label_.assign(size, kInfinity);
    state_.assign(size, kUntouched);
    rate_cache_.assign(size, -1.0F);
  }
  touched_.clear();
  buckets_.resize(kBuckets);
  for (auto& bucket : buckets_) bucket.clear();
  first_bucket_ = 0;
  first_number_ = 0;
  pending_ = settled_ = 0;
  task_ = std::move(task);
  const float resolution = static_cast<float>(task_.geometry.resolution);
  bucket_width_ = *std::min_element(task_.rate->begin(), task_.rate->end()) * resolution;
  end_slack_ = kEndSlackCells * bucket_width_;
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
      if (relaxedRate(cell) == kInfinity) continue;
      const auto index = static_cast<std::uint32_t>(task_.geometry.index(cell));
      touched_.push_back(index);
      state_[index] = kOpen;
      label_[index] = 0.0F;
      push(0.0F, index);
    }
  }
}

float DistanceField::relaxedRate(const sarn::CellIndex& cell) {
  float& cached = rate_cache_[task_.geometry.index(cell)];
  if (cached >= 0.0F) return cached;
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
  cached = best * static_cast<float>(task_.geometry.resolution);
  touched_.push_back(static_cast<std::uint32_t>(task_.geometry.index(cell)));
  return cached;
}

void DistanceField::push(float key, std::uint32_t cell) {
  const auto number = static_cast<std::uint64_t>(key / bucket_width_);
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
    if (state_[entry.cell] == kSettled || entry.key > label_[entry.cell]) continue;
    if (static_cast<std::uint64_t>(entry.key / bucket_width_) > first_number_) {  // did not fit into the ring
      push(entry.key, entry.cell);
      continue;
    }
    settle(entry);
  }
  bucket.clear();
  first_bucket_ = (first_bucket_ + 1) % kBuckets;
  ++first_number_;
  return true;
}

void DistanceField::settle(const Entry& entry) {
  const int width = task_.geometry.width;
  const sarn::CellIndex cell{static_cast<int>(entry.cell) % width, static_cast<int>(entry.cell) / width};
  state_[entry.cell] = kSettled;
  ++settled_;
  relax(cell, entry.key);
}

void DistanceField::relax(const sarn::CellIndex& from, float cost) {
  const float rate = relaxedRate(from);
  for (const Move& move : moves()) {
    const sarn::CellIndex to{from.x + move.dx, from.y + move.dy};
    if (!task_.geometry.contains(to)) continue;
    const auto index = static_cast<std::uint32_t>(task_.geometry.index(to));
    if (state_[index] == kSettled) continue;
    const float next_rate = relaxedRate(to);
    if (next_rate == kInfinity) continue;
    if (move.length > 2.0F && relaxedRate({from.x + move.via_x[0], from.y + move.via_y[0]}) == kInfinity &&
        relaxedRate({from.x + move.via_x[1], from.y + move.via_y[1]}) == kInfinity) {
      continue;
    }
    float label = cost + 0.5F * move.length * (rate + next_rate);
    if (label >= label_[index]) continue;
    if (task_.floor) {
      const float floor = task_.floor(to);
      if (floor > 0.0F) label = std::max(label, (floor + end_slack_) * kDetour);
      if (label >= label_[index]) continue;
    }
    if (state_[index] == kUntouched) {
      touched_.push_back(index);
      state_[index] = kOpen;
    }
    label_[index] = label;
    push(label, index);
  }
}

float DistanceField::lowerBound(float label) const { return std::max(0.0F, label / kDetour - end_slack_); }

float DistanceField::at(const sarn::CellIndex& cell) {
  const std::size_t index = task_.geometry.index(cell);
  unsigned turns = 0;
  while (state_[index] != kSettled) {
    if ((++turns & 15U) == 0 && keep_going_ && !keep_going_()) {
      return lowerBound(static_cast<float>(first_number_) * bucket_width_);
    }
    if (!advanceOneBucket()) return kInfinity;
  }
  return lowerBound(label_[index]);
}

}  // namespace lattice_planner
