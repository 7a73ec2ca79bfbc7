// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "lattice_planner/traversal_map.h"
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
  double start_x = 0.0;      // [m] where most questions will be asked: the field grows towards it
  double start_y = 0.0;      // [m]
  double goal_x = 0.0;       // [m]
  double goal_y = 0.0;       // [m]
  double goal_radius = 0.0;  // [m] zero cost inside
  /// Lower bound of the cost to go from anywhere in a cell, known otherwise; 0 when nothing is known. A
  /// function of the goal's place and of floor_id. May be empty.
  std::function<float(const sarn::CellIndex&)> floor;
  float guess_scale =
      0.97F;  // likely cost of a way / cost of the grid's path, which turns only by 22 degrees
  double floor_radius = 0.0;  // [m] around the goal within which floor is asked
  double floor_id = 0.0;      // tells two floors around one place from each other, for example the goal's yaw
};

/// Lower bound of the cost to go from each cell, from the goal over the static layer; people, heading and
/// speed aside. Computed only as far as it is asked, towards the start: reverse resumable A* (Silver,
/// "Cooperative pathfinding", AIIDE 2005). What is known stays known: for the next request with the same goal
/// only what a change of the static layer can have touched is computed again.
///
/// The grid is 16-connected (moves of 1, sqrt 2 and sqrt 5 cells), whose distances exceed the Euclidean ones
/// by less than 2.75 per cent; the result is scaled by that. Obstacles are thinned and costs are taken as the
/// smallest of the 3 x 3 neighbourhood: the shortest curve round obstacles turns only at corners of cells, so
/// that, shifted by half a cell, it becomes a grid path of no more than 1.0275 of its length that stays
/// within one cell of it. What the ends add (less than one and a half cells) is taken off. Hence no path is
/// overestimated.
class DistanceField {
 public:
  /// The likely cost to go from a place and its slope, between the centres of four cells.
  struct Guess {
    float cost = 0.0F;     // not a bound; infinity: the goal cannot be reached
    float slope_x = 0.0F;  // [1/m]
    float slope_y = 0.0F;  // [1/m]
  };

  void reset(const DistanceFieldTask& task);
  /// Lower bound of the cost from the cell to the goal; infinity when the goal cannot be reached.
  /// `keep_going` is asked now and then: false ends the computation; then the answer is the bound known so
  /// far (the wave's front).
  [[nodiscard]] float at(const sarn::CellIndex& cell);
  /// What the grid's paths say of a point inside the map.
  [[nodiscard]] Guess guess(double x, double y);
  /// Goes on until every cell is known through which the start's way to the goal is longer than the shortest
  /// by no more than `extra`.
  void computeDetours(float extra);
  /// Bound of a cell as far as it is known; infinity when the computation has not come to it.
  [[nodiscard]] float known(const sarn::CellIndex& cell) const;
  /// Cost from the cell's centre to the goal, likely rather than bounded; infinity where it is not known yet.
  [[nodiscard]] float knownGuess(const sarn::CellIndex& cell) const;
  void setKeepGoing(std::function<bool()> keep_going) { keep_going_ = std::move(keep_going); }
  [[nodiscard]] std::size_t settled() const { return settled_count_; }  // since the field was made anew
  [[nodiscard]] std::size_t reused() const { return reused_; }          // cells known from the last request

 private:
  struct Entry {
    float label = 0.0F;
    sarn::CellIndex cell;
    std::int32_t number = 0;  // of its bucket
  };
  struct Move {
    int dx;
    int dy;
    float length;           // [cells]
    std::ptrdiff_t offset;  // in the array of cells
    std::ptrdiff_t via[2];  // cells that a knight's move passes between
  };

  [[nodiscard]] bool sameTask(const DistanceFieldTask& task) const;
  void layOut();
  void buildMoves();
  void clear();
  void seed();
  void keepLabelsBelow(float label);
  void forgetQueue();
  void collectGoal();
  void collectBorder();
  bool advanceOneBucket();
  void relaxNeighbours(const sarn::CellIndex& cell, std::uint32_t index);
  template <bool kInterior>
  void relaxNeighboursOf(const sarn::CellIndex& cell, std::uint32_t index);
  void push(float label, const sarn::CellIndex& cell);
  void settle(std::uint32_t index);
  [[nodiscard]] float keyOf(float label, const sarn::CellIndex& cell) const;
  [[nodiscard]] float frontLabel(const sarn::CellIndex& cell) const;
  [[nodiscard]] float lowerBound(float label) const;
  [[nodiscard]] sarn::CellIndex cellOf(std::uint32_t index) const;

  DistanceFieldTask task_;
  TraversalMap map_;
  std::function<bool()> keep_going_;
  std::vector<Move> moves_;
  std::array<float, 256> half_rate_{};   // [cost per half cell edge] by thinned cost
  std::vector<float> labels_;            // infinity: not reached
  std::vector<std::uint8_t> settled_;    // 1: the label is final
  std::vector<sarn::CellIndex> border_;  // where the wave begins
  int first_row_ = 0;                    // rows with labels
  int last_row_ = -1;
  std::vector<std::vector<Entry>> buckets_;  // ring, each half a cheapest straight step wide
  std::size_t first_bucket_ = 0;
  std::int64_t first_number_ = 0;  // of the first bucket
  std::size_t pending_ = 0;
  std::size_t settled_count_ = 0;
  std::size_t reused_ = 0;
  float cheapest_step_ = 1.0F;
  float bucket_width_ = 1.0F;
  float buckets_per_cost_ = 1.0F;
  float end_slack_ = 0.0F;
  sarn::CellIndex start_;
  sarn::CellIndex floor_low_;  // box of cells that floor is asked for
  sarn::CellIndex floor_high_;
};

}  // namespace lattice_planner
