// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "lattice_planner/lattice_planner.h"

namespace lattice_planner {
namespace {

/// An empty room of 8 m x 8 m in which somebody walks along the wall, metres away from robot and goal.
class RoomWithAWalker {
 public:
  RoomWithAWalker() : layers_(30, std::vector<std::uint8_t>(static_.size(), 0)) {
    view_.geometry = {160, 160, 0.05, 0.0, 0.0};
    view_.static_costs = static_.data();
    view_.layer_duration = 0.5;
    for (int k = 0; k < 30; ++k) {
      for (int y = 2; y < 12; ++y) {
        for (int x = 0; x < 10; ++x) {
          const sarn::CellIndex cell{4 * k + x, y};
          layers_[static_cast<std::size_t>(k)][view_.geometry.index(cell)] = sarn::kLethalObstacle;
        }
      }
      view_.layers.push_back(layers_[static_cast<std::size_t>(k)].data());
    }
  }
  [[nodiscard]] const sarn::TimedCostmapView& view() const { return view_; }

 private:
  std::vector<std::uint8_t> static_ = std::vector<std::uint8_t>(160U * 160U, 0);
  std::vector<std::vector<std::uint8_t>> layers_;
  sarn::TimedCostmapView view_;
};

TEST(Arrival, isNotPutOffUntilPeopleWhoAreFarAwayHaveStopped) {
  const RoomWithAWalker room;
  sarn::TimedCostmapView alone = room.view();
  alone.layers.clear();
  LatticePlanner planner(PlannerParams{});
  const PlanRequest request{{4.25, 6.4, -0.26, 0.0, 0.0, 0.3}, {4.0, 6.0, -1.57}, 5.0};
  const PlanResult with_walker = planner.plan(request, room.view());
  const PlanResult without = planner.plan(request, alone);
  ASSERT_EQ(with_walker.status, PlanStatus::kComplete);
  ASSERT_EQ(without.status, PlanStatus::kComplete);
  EXPECT_LT(with_walker.cost, 1.1 * without.cost);
}

}  // namespace
}  // namespace lattice_planner
