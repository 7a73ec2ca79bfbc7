// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sarn_common/grid.h"

namespace kobuki_sim {

/// Something round to walk around.
struct Disc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // [m]
  double radius = 0.0;                               // [m] with the room to keep
};

/// Where a search may go: cells with enough clearance that no disc covers.
struct SearchSpace {
  const sarn::Grid<float>* clearance;  // [m] not owned
  double needed;                       // [m] clearance of an open cell
  const std::vector<Disc>* discs;      // not owned; radii with the body's
};

/// A* (Hart, Nilsson and Raphael 1968) over the 8-connected open cells of a grid, without cutting corners.
/// Keeps its working memory between searches and touches only the cells that a search visits: one per thread.
class RouteSearch {
 public:
  /// Prepares for searches in a space, which has to stay.
  void enter(const SearchSpace& space);
  [[nodiscard]] bool isOpen(const sarn::CellIndex& cell) const;
  /// Cells of a shortest way from start to goal (both open), or false. Costs are at most a hundredth above
  /// the least.
  [[nodiscard]] bool find(const sarn::CellIndex& start, const sarn::CellIndex& goal,
                          std::vector<sarn::CellIndex>& way);

 private:
  struct Node {
    float cost = 0.0F;          // [cells]
    std::uint32_t parent = 0;   // index of a cell
    std::uint32_t visit = 0;    // search in which cost and parent were written
    std::uint32_t covered = 0;  // space in which a disc covers the cell
  };
  struct Open {
    float estimate;
    std::uint32_t index;
  };

  void cover(const Disc& disc);
  void push(const Open& open);
  [[nodiscard]] Open pop();
  void expand(std::uint32_t index, const sarn::CellIndex& goal);
  [[nodiscard]] sarn::CellIndex cellOf(std::uint32_t index) const;

  SearchSpace space_{nullptr, 0.0, nullptr};
  std::vector<Node> nodes_;
  std::uint32_t search_ = 0;   // number of the present search
  std::uint32_t entered_ = 0;  // number of the present space
  std::vector<Open> heap_;
};

}  // namespace kobuki_sim
