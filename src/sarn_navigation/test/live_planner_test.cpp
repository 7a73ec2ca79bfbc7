// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/live_planner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "drawn_scene.h"

namespace sarn_navigation {
namespace {

lattice_planner::PlannerParams params(double social_weight) {
  lattice_planner::PlannerParams p;
  p.table_radius = 0.0;
  p.max_expansions = 20000;
  p.social_weight = social_weight;
  return p;
}

/// A hall with a dear strip in its middle, as people make it.
class LivePlannerTest : public testing::Test {
 protected:
  LivePlannerTest() : scene_(std::vector<std::string>(16, std::string(32, '.'))) {
    std::vector<std::string> people(16, std::string(32, '.'));
    for (std::size_t row = 6; row < 10; ++row) {
      for (std::size_t x = 12; x < 20; ++x) people[row][x] = '9';
    }
    for (int i = 0; i < 60; ++i) scene_.addLayer(people);
    scene_.view().layer_duration = 1.0;
  }
  /// How far [m] the plan leaves the straight line.
  double detour(LivePlanner& planner) {
    const auto result = planner.plan({{0.6, 2.0, 0.0, 0.0, 0.0, 0.0}, {7.4, 2.0, 0.0}, 10.0}, scene_.view());
    EXPECT_EQ(result.status, lattice_planner::PlanStatus::kComplete);
    double largest = 0.0;
    for (const auto& point : result.trajectory.points) largest = std::max(largest, std::abs(point.y - 2.0));
    return largest;
  }
  DrawnScene scene_;
};

TEST_F(LivePlannerTest, plansFollowTheParametersSetLast) {
  LivePlanner planner(params(0.0));
  EXPECT_LT(detour(planner), 0.3) << "people cost nothing";
  planner.setParams(params(2.0));
  planner.setParams(params(20.0));
  EXPECT_DOUBLE_EQ(planner.params().social_weight, 20.0);
  planner.waitUntilReady();
  EXPECT_GT(detour(planner), 0.4) << "goes round the strip";
}

TEST_F(LivePlannerTest, refusesParametersWithProblemsAndKeepsTheOldOnes) {
  LivePlanner planner(params(3.0));
  EXPECT_THROW(planner.setParams(params(std::nan(""))), std::invalid_argument);
  EXPECT_DOUBLE_EQ(planner.params().social_weight, 3.0);
}

TEST_F(LivePlannerTest, mayBeTunedFromAnotherThreadWhileItPlans) {
  LivePlanner planner(params(0.0));
  std::atomic<bool> done{false};
  std::thread tuner([&] {
    for (int i = 0; !done; ++i) planner.setParams(params(i % 10));
  });
  for (int i = 0; i < 10; ++i) (void)detour(planner);
  done = true;
  tuner.join();
}

}  // namespace
}  // namespace sarn_navigation
