// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/space_time_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lattice_planner {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kCell = 0.1;             // [m]
constexpr double kTimeStep = 0.5;         // [s]
constexpr double kLongestHorizon = 15.0;  // [s]
constexpr double kDetourReach = 3.0;      // [m] longer than the shortest way that is still of interest
constexpr double kLateDetourReach = 1.5;  // [m] likewise, where those who stay are known
constexpr double kLeastReach = 1.0;       // [m] around the start
constexpr double kEase = 0.97;            // few directions make a path this much too long
constexpr int kPadding = 3;               // [cells] the longest move
// [of time_weight] For a cell with a person: a start inside must get out.
constexpr float kForbiddenRate = 20.0F;

}  // namespace

void SpaceTimeField::reset(const SpaceTimeTask& task, DistanceField& distance, DistanceField* late) {
  layOut(task);
  sampleStatic(task, distance, late);
  const auto reach = [&](int k) { return task.max_speed * k * time_step_ + kLeastReach; };
  sampleRates(task, task.start_time + steps_ * time_step_, reach(steps_), next_rates_);
  for (int k = steps_ - 1; k >= 0; --k) {
    sampleRates(task, task.start_time + k * time_step_, reach(k), rates_);
    stepBack(rates_, next_rates_, costs_[static_cast<std::size_t>(k + 1)],
             costs_[static_cast<std::size_t>(k)], reach(k));
    keepArrivals(task, costs_[static_cast<std::size_t>(k)]);
    rates_.swap(next_rates_);
  }
}

void SpaceTimeField::layOut(const SpaceTimeTask& task) {
  fine_ = task.costmap->geometry;
  stride_ = std::max(1, static_cast<int>(std::lround(kCell / fine_.resolution)));
  cell_ = stride_ * fine_.resolution;
  start_time_ = task.start_time;
  const double horizon = std::clamp(task.end_time - task.start_time, 0.0, kLongestHorizon);
  time_step_ = kTimeStep;
  steps_ = static_cast<int>(std::ceil(horizon / time_step_));
  const double reach = task.max_speed * steps_ * time_step_ + kLeastReach;
  const int half = static_cast<int>(std::ceil(reach / cell_)) + kPadding + 1;
  width_ = height_ = 2 * half + 1;
  center_column_ = center_row_ = half;
  // Columns lie on centres of fine cells.
  fine_start_ = fine_.cellAtUnbounded(task.start_x, task.start_y);
  origin_x_ = fine_.center(fine_start_).x() - half * cell_;
  origin_y_ = fine_.center(fine_start_).y() - half * cell_;
  moves_.clear();
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const double length = std::hypot(dx, dy) * cell_;
      if (length > 1.25 * task.max_speed * time_step_) continue;
      const double duration = std::max(time_step_, length / task.max_speed);
      moves_.push_back(
          {static_cast<std::ptrdiff_t>(dy) * width_ + dx, static_cast<float>(kEase * duration),
           static_cast<float>(kEase * (task.time_weight * duration + task.length_weight * length))});
    }
  }
}

void SpaceTimeField::sampleStatic(const SpaceTimeTask& task, DistanceField& distance, DistanceField* late) {
  const auto size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  static_rates_.assign(size, kInfinity);
  costs_.resize(std::max(costs_.size(), static_cast<std::size_t>(steps_) + 1));
  for (int k = 0; k <= steps_; ++k) costs_[static_cast<std::size_t>(k)].assign(size, kInfinity);
  const double per_metre = task.time_weight / task.max_speed + task.length_weight;
  if (late != nullptr) {
    late->computeDetours(static_cast<float>(kLateDetourReach * per_metre));
  } else {
    distance.computeDetours(static_cast<float>(kDetourReach * per_metre));
  }
  alone_.assign(size, kInfinity);
  std::vector<float>& last = costs_[static_cast<std::size_t>(steps_)];
  for (int row = kPadding; row < height_ - kPadding; ++row) {
    for (int column = kPadding; column < width_ - kPadding; ++column) {
      const sarn::CellIndex cell = fineCell(column, row);
      if (!fine_.contains(cell)) continue;
      const std::uint8_t cost = task.costmap->static_costs[fine_.index(cell)];
      const bool near_start = std::abs(column - center_column_) <= 2 && std::abs(row - center_row_) <= 2;
      if ((*task.forbidden_static)[cost] && !near_start) continue;
      const auto index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
      static_rates_[index] = (*task.static_rate)[cost];
      const float alone = distance.knownGuess(cell);
      last[index] = late != nullptr ? late->knownGuess(cell) : alone;
      alone_[index] = late != nullptr && alone == kInfinity ? 0.0F : alone;
    }
  }
}

/// Within `reach` [m] of the start, and the longest move.
void SpaceTimeField::sampleRates(const SpaceTimeTask& task, double t, double reach,
                                 std::vector<float>& rates) const {
  rates = static_rates_;
  const int layer = task.costmap->layerAt(t);
  if (layer < 0) return;
  const std::uint8_t* const costs = task.costmap->layers[static_cast<std::size_t>(layer)];
  const float forbidden_rate = kForbiddenRate * static_cast<float>(task.time_weight);
  const int half = std::min(static_cast<int>(reach / cell_) + kPadding + 1, center_column_ - kPadding);
  for (int row = center_row_ - half; row <= center_row_ + half; ++row) {
    for (int column = center_column_ - half; column <= center_column_ + half; ++column) {
      float& rate = rates[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(column)];
      if (rate == kInfinity) continue;
      const std::uint8_t cost = costs[fine_.index(fineCell(column, row))];
      if (cost == 0) continue;
      const float social = (*task.social_rate)[cost];
      rate = task.combine_with_max ? std::max(rate, social) : rate + social;
      if ((*task.forbidden_social)[cost]) rate += forbidden_rate;
    }
  }
}

/// costs(c) = min over moves of cost(move) + duration * mean rate + next(c'), row by row; people make nothing
/// cheaper than it is without them.
void SpaceTimeField::stepBack(const std::vector<float>& rates, const std::vector<float>& next_rates,
                              const std::vector<float>& next, std::vector<float>& costs, double reach) {
  const double cells = reach / cell_;
  for (int row = kPadding; row < height_ - kPadding; ++row) {
    const double dy = row - center_row_;
    if (std::abs(dy) > cells) continue;
    const int half = static_cast<int>(std::sqrt(cells * cells - dy * dy));
    const int first = std::max(kPadding, center_column_ - half);
    const int last = std::min(width_ - kPadding - 1, center_column_ + half);
    const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(row) * width_ + first;
    const int count = last - first + 1;
    float* const out = costs.data() + begin;
    const float* const rate = rates.data() + begin;
    const float* const alone = alone_.data() + begin;
    for (const Move& move : moves_) {
      const float* const to = next.data() + begin + move.offset;
      const float* const to_rate = next_rates.data() + begin + move.offset;
      const float half_duration = 0.5F * move.duration;
      for (int i = 0; i < count; ++i) {
        out[i] = std::min(out[i], move.cost + half_duration * (rate[i] + to_rate[i]) + to[i]);
      }
    }
    for (int i = 0; i < count; ++i) out[i] = std::max(out[i], alone[i]);
  }
}

/// The goal absorbs: to be there costs no more early than late. Without this, every second before the
/// horizon's end would look like a second still to pay, and the search would rather dawdle than arrive.
void SpaceTimeField::keepArrivals(const SpaceTimeTask& task, std::vector<float>& costs) const {
  const std::vector<float>& last = costs_[static_cast<std::size_t>(steps_)];
  const int reach = static_cast<int>(std::ceil(task.goal_radius / cell_));
  const int column = static_cast<int>(std::lround((task.goal_x - origin_x_) / cell_));
  const int row = static_cast<int>(std::lround((task.goal_y - origin_y_) / cell_));
  for (int y = std::max(row - reach, 0); y <= std::min(row + reach, height_ - 1); ++y) {
    for (int x = std::max(column - reach, 0); x <= std::min(column + reach, width_ - 1); ++x) {
      const double dx = origin_x_ + x * cell_ - task.goal_x;
      const double dy = origin_y_ + y * cell_ - task.goal_y;
      const bool nearest = x == column && y == row;
      if (!nearest && std::hypot(dx, dy) > task.goal_radius) continue;
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
      costs[i] = std::min(costs[i], last[i]);
    }
  }
}

SpaceTimeField::Estimate SpaceTimeField::slice(const std::vector<float>& costs, double x, double y) const {
  const double gx = (x - origin_x_) / cell_;
  const double gy = (y - origin_y_) / cell_;
  if (!(gx >= 0.0 && gy >= 0.0 && gx < width_ - 1 && gy < height_ - 1)) return {kInfinity, 0.0F, 0.0F};
  const int column = static_cast<int>(gx);
  const int row = static_cast<int>(gy);
  const auto fx = static_cast<float>(gx - column);
  const auto fy = static_cast<float>(gy - row);
  const float* const c = costs.data() + static_cast<std::ptrdiff_t>(row) * width_ + column;
  const float c00 = c[0], c10 = c[1], c01 = c[width_], c11 = c[width_ + 1];
  const float least = std::min(std::min(c00, c10), std::min(c01, c11));
  if (std::max(std::max(c00, c10), std::max(c01, c11)) == kInfinity) return {least, 0.0F, 0.0F};
  const float bottom = c00 + fx * (c10 - c00);
  const float top = c01 + fx * (c11 - c01);
  const auto per_cell = static_cast<float>(1.0 / cell_);
  return {bottom + fy * (top - bottom), ((1.0F - fy) * (c10 - c00) + fy * (c11 - c01)) * per_cell,
          (top - bottom) * per_cell};
}

SpaceTimeField::Estimate SpaceTimeField::at(double x, double y, double t) const {
  const double step = std::clamp((t - start_time_) / time_step_, 0.0, static_cast<double>(steps_));
  const int low = static_cast<int>(step);
  const Estimate a = slice(costs_[static_cast<std::size_t>(low)], x, y);
  if (low == steps_) return a;
  const Estimate b = slice(costs_[static_cast<std::size_t>(low + 1)], x, y);
  if (a.cost == kInfinity) return b;
  if (b.cost == kInfinity) return a;
  const auto f = static_cast<float>(step - low);
  return {a.cost + f * (b.cost - a.cost), a.slope_x + f * (b.slope_x - a.slope_x),
          a.slope_y + f * (b.slope_y - a.slope_y)};
}

}  // namespace lattice_planner
