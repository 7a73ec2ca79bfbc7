// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/trajectory_cost.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "lattice_planner/lattice_planner.h"

namespace lattice_planner {
namespace {

class TrajectoryCost : public ::testing::Test {
 protected:
  TrajectoryCost() {
    view_.geometry = {40, 10, 0.1, 0.0, 0.0};
    view_.static_costs = static_.data();
    view_.layer_duration = 2.0;
  }
  std::vector<std::uint8_t> static_ = std::vector<std::uint8_t>(400, 0);
  std::vector<std::uint8_t> people_ = std::vector<std::uint8_t>(400, 126);
  sarn::TimedCostmapView view_;
  PlannerParams params_;
  // 4 s at 0.5 m/s.
  sarn::TimedTrajectory straight_{{{0.5, 0.5, 0.0, 0.5, 0.0, 0.0}, {2.5, 0.5, 0.0, 0.5, 0.0, 4.0}}};
};

TEST_F(TrajectoryCost, isTimeAndLengthOnAFreeMap) {
  EXPECT_NEAR(trajectoryCost(params_, straight_, view_, 0.0),
              4.0 * params_.time_weight + 2.0 * params_.length_weight, 1e-9);
  EXPECT_NEAR(trajectoryCost(params_, straight_, view_, 3.0),
              params_.time_weight + 0.5 * params_.length_weight, 1e-9);
}

TEST_F(TrajectoryCost, chargesPeopleForTheSecondsOfTheirLayer) {
  const double alone = trajectoryCost(params_, straight_, view_, 0.0);
  view_.layers = {people_.data()};  // from 0 to 2 s, half of the dearest cost
  EXPECT_NEAR(trajectoryCost(params_, straight_, view_, 0.0) - alone, 0.5 * params_.social_weight * 2.0,
              1e-6);
}

TEST_F(TrajectoryCost, agreesWithThePlannersOwnOnAFreeMap) {
  const PlanResult result = LatticePlanner(params_).plan({{0.5, 0.5, 0, 0, 0, 0}, {3.0, 0.5, 0}, 2.0}, view_);
  ASSERT_EQ(result.status, PlanStatus::kComplete);
  EXPECT_NEAR(trajectoryCost(params_, result.trajectory, view_, 0.0), result.cost, 0.01 * result.cost);
}

}  // namespace
}  // namespace lattice_planner
