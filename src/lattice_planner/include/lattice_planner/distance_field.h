// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "sarn_common/grid.h"

namespace lattice_planner {

/// What the field needs to know about the static layer and the cost function.
struct DistanceFieldTask {
  sarn::GridGeometry geometry;
  const std::uint8_t* costs = nullptr;             // static layer, row-major
  const std::array<bool, 256>* blocked = nullptr;  // by cell cost
  const std::array<float, 256>* rate = nullptr;    // [1/m] smallest cost of a metre in a cell of this cost
  std::function<bool(const sarn::CellIndex&)>
      exempt;                // cells that are passable although blocked; may be empty
  double goal_x = 0.0;       // [m]
  double goal_y = 0.0;       // [m]
  double goal_radius = 0.0;  // [m] zero cost inside
  /// Lower bound of the cost to go from anywhere in a cell, known otherwise; 0 when nothing is known. May be
  /// empty.
  std::function<float(const sarn::CellIndex&)> floor;
  double floor_radius = 0.0;  // [m] around the goal within which floor is asked
};

/// Lower bound of the cost to go from each cell, by Dijkstra from the goal over the static layer; people,
/// heading and speed aside. Computed only as far as it is asked.
///
/// The grid is 16-connected (moves of 1, sqrt 2 and sqrt 5 cells), whose distances exceed the Euclidean ones
/// by less than 2.75 per cent; the result is scaled by that. Obstacles are thinned and costs are taken as the
/// smallest of the 3 x 3 neighbourhood: the shortest curve round obstacles turns only at corners of cells, so
/// that, shifted by half a cell, it becomes a grid path of no more than 1.0275 of its length that stays
/// within one cell of it. What the ends add (less than one and a half cells) is taken off. Hence no path is
/// overestimated.
class DistanceField {
 public:
  void reset(DistanceFieldTask task);
  /// Lower bound of the cost from the cell to the goal; infinity when the goal cannot be reached.
  /// `keep_going` is asked now and then: false ends the computation; then the answer is the bound known so
  /// far (the wave's front).
  [[nodiscard]] float at(const sarn::CellIndex& cell);
  /// Goes on until every cell with a smaller bound is known.
  void computeTo(float bound);
  /// Bound of a cell as far as it is known; infinity when the computation has not come to it.
  [[nodiscard]] float known(const sarn::CellIndex& cell) const;
  void setKeepGoing(std::function<bool()> keep_going) { keep_going_ = std::move(keep_going); }
  [[nodiscard]] std::size_t settled() const { return settled_; }

 private:
  struct Cell {
    float label;
    float rate;  // cheapest of the 3 x 3 neighbourhood [cost per cell edge]; infinity: all blocked; < 0: not
                 // known yet
    std::uint32_t settled;
  };
  struct Entry {
    float key;
    std::uint32_t cell;
  };
  struct Move {
    int dx;
    int dy;
    float length;  // [cells]
    int via_x[2];  // cells that a knight's move passes between
    int via_y[2];
    std::ptrdiff_t offset;  // in the array of cells
    std::ptrdiff_t via[2];
  };

  void seed();
  void buildMoves();
  bool advanceOneBucket();
  void relaxNeighbours(std::uint32_t index);
  template <bool kInterior>
  void relaxNeighboursOf(const sarn::CellIndex& cell, std::uint32_t index);
  void push(float key, std::uint32_t cell);
  [[nodiscard]] float rate(const sarn::CellIndex& cell, std::uint32_t index);
  [[nodiscard]] float computeRate(const sarn::CellIndex& cell);
  [[nodiscard]] float lowerBound(float label) const;

  DistanceFieldTask task_;
  std::function<bool()> keep_going_;
  std::vector<Move> moves_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> touched_;       // cells to clean at the next reset
  std::vector<std::vector<Entry>> buckets_;  // ring, each one straight cheapest step wide
  std::size_t first_bucket_ = 0;
  std::uint64_t first_number_ = 0;  // of the first bucket
  std::size_t pending_ = 0;
  std::size_t settled_ = 0;
  float bucket_width_ = 1.0F;
  float buckets_per_cost_ = 1.0F;
  float end_slack_ = 0.0F;
  sarn::CellIndex floor_low_;  // box of cells that floor is asked for
  sarn::CellIndex floor_high_;
};

}  // namespace lattice_planner
