// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lattice_planner/distance_field.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// What the field needs to know of the cost function; rates by cell cost.
struct SpaceTimeTask {
  const sarn::TimedCostmapView* costmap = nullptr;
  const std::array<float, 256>* static_rate = nullptr;  // [1/s]
  const std::array<float, 256>* social_rate = nullptr;  // [1/s]
  const std::array<bool, 256>* forbidden_static = nullptr;
  const std::array<bool, 256>* forbidden_social = nullptr;
  bool combine_with_max = false;  // the dearer of static and social cost counts, not their sum
  double time_weight = 1.0;       // [1/s]
  double length_weight = 0.0;     // [1/m]
  double max_speed = 0.5;         // [m/s]
  double goal_x = 0.0;            // [m]
  double goal_y = 0.0;            // [m]
  double goal_radius = 0.0;       // [m] whoever is this near has arrived, at any time
  double start_x = 0.0;           // [m]
  double start_y = 0.0;           // [m]
  double start_time = 0.0;        // [s]
  double end_time = 0.0;          // [s] from here on nothing changes with time
};

/// Estimate of the cost to go from a place at a time, people included: what a robot without inertia, that
/// moves in any direction, would pay. Dynamic programming backwards over (x, y, t) on a coarse grid, from the
/// distance field at the end of the people's horizon; only places that the robot can have reached by then. It
/// guides the search (which states to look at first) and does not bound it: the grid's rounding makes it too
/// small here and too large there.
class SpaceTimeField {
 public:
  struct Estimate {
    float cost = 0.0F;     // infinity: unknown here
    float slope_x = 0.0F;  // [1/m] gradient
    float slope_y = 0.0F;  // [1/m]
  };

  /// `late`: the way on for who comes when the people's horizon is over; none: as `distance`.
  void reset(const SpaceTimeTask& task, DistanceField& distance, DistanceField* late = nullptr);
  [[nodiscard]] Estimate at(double x, double y, double t) const;

 private:
  struct Move {
    std::ptrdiff_t offset;
    float duration;  // [s]
    float cost;      // time and length
  };

  void layOut(const SpaceTimeTask& task);
  void keepArrivals(const SpaceTimeTask& task, std::vector<float>& costs) const;
  void sampleStatic(const SpaceTimeTask& task, DistanceField& distance, DistanceField* late);
  void sampleRates(const SpaceTimeTask& task, double t, double reach, std::vector<float>& rates) const;
  void stepBack(const std::vector<float>& rates, const std::vector<float>& next_rates,
                const std::vector<float>& next, std::vector<float>& costs, double reach);
  [[nodiscard]] Estimate slice(const std::vector<float>& costs, double x, double y) const;
  [[nodiscard]] sarn::CellIndex fineCell(int column, int row) const {
    return {fine_start_.x + (column - center_column_) * stride_,
            fine_start_.y + (row - center_row_) * stride_};
  }

  std::vector<Move> moves_;
  sarn::GridGeometry fine_;
  sarn::CellIndex fine_start_;  // its cell below the centre
  int stride_ = 1;              // [fine cells] between columns
  double origin_x_ = 0.0;       // [m] centre of column 0
  double origin_y_ = 0.0;       // [m]
  double cell_ = 0.1;           // [m]
  int width_ = 0;
  int height_ = 0;
  int center_column_ = 0;  // of the start
  int center_row_ = 0;
  double start_time_ = 0.0;  // [s]
  double time_step_ = 0.5;   // [s]
  int steps_ = 0;
  std::vector<float> static_rates_;  // infinity: blocked
  std::vector<std::vector<float>>
      costs_;                 // [step][cell]; the last is the way on when people are gone or stay
  std::vector<float> alone_;  // [cell] the distance field
  std::vector<float> rates_;
  std::vector<float> next_rates_;
};

}  // namespace lattice_planner
