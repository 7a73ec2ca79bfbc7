// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/motion_lattice.h"

#include <gtest/gtest.h>

#include <set>

#include "lattice_planner/open_list.h"
#include "lattice_planner/state_pool.h"

namespace lattice_planner {
namespace {

TEST(MotionLattice, hasThreeByFiveSpeedsByDefault) {
  const MotionLattice lattice{PlannerParams{}};
  EXPECT_EQ(lattice.forwardSpeeds(), 3);
  EXPECT_EQ(lattice.angularSpeeds(), 5);
  EXPECT_DOUBLE_EQ(lattice.v(lattice.standingV()), 0.0);
  EXPECT_DOUBLE_EQ(lattice.omega(lattice.standingOmega()), 0.0);
  EXPECT_DOUBLE_EQ(lattice.v(2), 0.5);
  EXPECT_DOUBLE_EQ(lattice.omega(0), -1.0);
}

TEST(MotionLattice, keepsRaisesOrLowersEachSpeedByOneStep) {
  const MotionLattice lattice{PlannerParams{}};
  EXPECT_EQ(lattice.from(1, 2).size(), 9U);
  EXPECT_EQ(lattice.from(0, 0).size(), 4U);
  for (int v = 0; v < 3; ++v) {
    for (int omega = 0; omega < 5; ++omega) {
      std::set<std::pair<int, int>> seen;
      for (const MotionPrimitive& p : lattice.from(v, omega)) {
        EXPECT_LE(std::abs(p.v - v), 1);
        EXPECT_LE(std::abs(p.omega - omega), 1);
        EXPECT_TRUE(seen.insert({p.v, p.omega}).second);
      }
    }
  }
}

TEST(MotionLattice, waitsAndTurnsInPlace) {
  const MotionLattice lattice{PlannerParams{}};
  bool waits = false;
  bool turns = false;
  for (const MotionPrimitive& p : lattice.from(0, 2)) {
    if (p.v == 0 && p.omega == 2)
      waits = p.samples.back().x == 0.0 && p.dtheta == 0.0 && p.base_cost == 0.25F;
    if (p.v == 0 && p.omega == 3) turns = p.samples.back().x == 0.0 && std::abs(p.dtheta - 0.0625) < 1e-12;
  }
  EXPECT_TRUE(waits);
  EXPECT_TRUE(turns);
}

TEST(MotionLattice, movesOnTheArcOfTheMeanSpeeds) {
  const MotionLattice lattice{PlannerParams{}};
  for (const MotionPrimitive& p : lattice.from(1, 3)) {
    const sarn::Twist2D mean{0.5 * (0.25 + lattice.v(p.v)), 0.5 * (0.5 + lattice.omega(p.omega))};
    const sarn::Pose2D end = sarn::advance({}, mean, 0.25);
    EXPECT_NEAR(p.samples.back().x, end.x, 1e-12);
    EXPECT_NEAR(p.samples.back().y, end.y, 1e-12);
    EXPECT_NEAR(p.dtheta, mean.omega * 0.25, 1e-12);
    EXPECT_EQ(static_cast<int>(p.samples.size()), lattice.samplesPerStep());
  }
}

TEST(MotionLattice, leadsSpeedsOffTheLatticeBackOntoIt) {
  const MotionLattice lattice{PlannerParams{}};
  for (const MotionPrimitive& p : lattice.fromAny({0.1, 0.1})) {
    EXPECT_LE(std::abs(lattice.v(p.v) - 0.1), 0.25 + 1e-9);
    EXPECT_LE(std::abs(lattice.omega(p.omega) - 0.1), 0.5 + 1e-9);
  }
  const auto too_fast = lattice.fromAny({2.0, -9.0});
  ASSERT_EQ(too_fast.size(), 1U);
  EXPECT_EQ(too_fast.front().v, 2);
  EXPECT_EQ(too_fast.front().omega, 0);
}

TEST(PlannerParams, nameLimitsOffTheLattice) {
  PlannerParams params;
  params.max_vel_x = 0.45;
  const auto problems = sarn::problems(params);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems.front().find("max_vel_x: 0.45"), std::string::npos) << problems.front();
}

TEST(PlannerParams, equalTheShippedYaml) {
  for (const char* file : {"config/lattice_planner.yaml", "config/ancestor.yaml"}) {
    const YAML::Node yaml = YAML::LoadFile(file);
    PlannerParams params;
    EXPECT_TRUE(sarn::setFromYaml(yaml, params).empty()) << file;
    EXPECT_EQ(yaml.size(), sarn::fieldNames<PlannerParams>().size()) << file;
    for (const std::string& name : sarn::fieldNames<PlannerParams>())
      EXPECT_TRUE(yaml[name]) << file << ": " << name;
  }
}

TEST(PlannerParams, shippedYamlHoldsTheDefaults) {
  const YAML::Node yaml = YAML::LoadFile("config/lattice_planner.yaml");
  PlannerParams params;
  PlannerParams zero;
  ASSERT_TRUE(sarn::setFromYaml(yaml, params).empty());
  EXPECT_DOUBLE_EQ(params.social_weight, zero.social_weight);
  EXPECT_DOUBLE_EQ(params.heuristic_weight, zero.heuristic_weight);
  EXPECT_EQ(params.heading_bins, zero.heading_bins);
  EXPECT_EQ(params.max_states, zero.max_states);
}

TEST(OpenList, givesTheSmallestKeyFirst) {
  OpenList open;
  unsigned value = 1;
  for (StateId i = 0; i < 1000; ++i) {
    value = value * 1664525U + 1013904223U;
    open.push({static_cast<float>(value % 997U), 0.0F, i});
  }
  open.rebuild([](OpenList::Entry& e) {
    e.key = -e.key;
    return e.id % 3 != 0;
  });
  float last = -1e9F;
  std::size_t count = 0;
  for (; !open.empty(); ++count) {
    const OpenList::Entry e = open.pop();
    EXPECT_GE(e.key, last);
    EXPECT_NE(e.id % 3, 0U);
    last = e.key;
  }
  EXPECT_EQ(count, 666U);
}

TEST(FrontierBound, isTheSmallestValueLeft) {
  FrontierBound bound;
  bound.reset(0.1);
  bound.add(5.0);
  bound.add(3.0);
  EXPECT_NEAR(bound.lowest(), 3.0, 0.1);
  bound.remove(3.0);
  EXPECT_NEAR(bound.lowest(), 5.0, 0.1);
  bound.add(1.0);
  EXPECT_LE(bound.lowest(), 1.0);
  EXPECT_NEAR(bound.lowest(), 1.0, 0.1);
}

TEST(StatePool, findsTheLatestRecordOfAKeyAndForgetsAll) {
  StatePool pool;
  SearchState state;
  for (std::uint64_t key = 0; key < 100000; ++key) {
    state.g = static_cast<double>(key);
    pool.put(key * 7919U, state);
  }
  state.g = -1.0;
  const StateId newer = pool.put(7919U * 500U, state);
  EXPECT_EQ(pool.find(7919U * 500U), newer);
  EXPECT_DOUBLE_EQ(pool[pool.find(7919U * 501U)].g, 501.0);
  EXPECT_EQ(pool.find(3), kNoState);
  pool.reset();
  EXPECT_EQ(pool.find(7919U * 500U), kNoState);
}

}  // namespace
}  // namespace lattice_planner
