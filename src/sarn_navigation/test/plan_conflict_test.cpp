// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/plan_conflict.h"

#include <gtest/gtest.h>

#include "drawn_scene.h"

namespace sarn_navigation {
namespace {

/// Straight along y = 0.6 m at 0.5 m/s from x = 0.1 m at t = 10 s.
sarn::TimedTrajectory straight() {
  sarn::TimedTrajectory trajectory;
  for (int i = 0; i <= 8; ++i)
    trajectory.points.push_back({0.1 + 0.25 * i, 0.6, 0.0, 0.5, 0.0, 10.0 + 0.5 * i});
  return trajectory;
}

const std::vector<std::string> kFree = {"..........", "..........", "..........", ".........."};

TEST(PlanConflict, isNoneOnAFreeMap) {
  DrawnScene scene(kFree);
  EXPECT_FALSE(firstConflict(straight(), scene.view(), 10.0, 20.0));
  EXPECT_FALSE(firstConflict({}, scene.view(), 10.0, 20.0));
}

TEST(PlanConflict, namesTimeAndPlaceOfAWall) {
  DrawnScene scene({"..........", "....#.....", "....#.....", ".........."});
  const auto conflict = firstConflict(straight(), scene.view(), 10.0, 20.0);
  ASSERT_TRUE(conflict);
  EXPECT_FALSE(conflict->with_people);
  EXPECT_NEAR(conflict->where.x, 1.0, 0.06);
  EXPECT_NEAR(conflict->where.t, 11.8, 0.11);
  EXPECT_FALSE(firstConflict(straight(), scene.view(), 10.0, 11.5)) << "beyond the horizon";
}

TEST(PlanConflict, looksAtThePeopleOfThatTime) {
  DrawnScene scene(kFree);
  for (int i = 0; i < 4; ++i) scene.addEmptyLayer();
  scene.view().first_layer_time = 10.0;
  scene.view().layer_duration = 1.0;
  scene.forbid(0, {1.5, 0.6}, 0.3);  // gone before the robot comes
  EXPECT_FALSE(firstConflict(straight(), scene.view(), 10.0, 20.0));
  scene.forbid(2, {1.5, 0.6}, 0.3);  // there when it comes
  const auto conflict = firstConflict(straight(), scene.view(), 10.0, 20.0);
  ASSERT_TRUE(conflict);
  EXPECT_TRUE(conflict->with_people);
  EXPECT_GE(conflict->where.t, 12.0);
}

TEST(PlanConflict, allowsTheWayOutOfAForbiddenPlace) {
  DrawnScene scene({"..........", "..........", "ii........", ".........."});
  EXPECT_FALSE(firstConflict({{{0.1, 0.3, 0.0, 0.5, 0.0, 0.0}, {2.1, 0.3, 0.0, 0.5, 0.0, 4.0}}}, scene.view(),
                             0.0, 9.0));
}

TEST(PlanConflict, looksAtTheOutlineOfARobotThatIsNotRound) {
  // Below its way, x in [1, 1.25].
  DrawnScene scene({"..........", "..........", "..........", "..........", "....#....."});
  scene.addEmptyLayer();
  lattice_planner::FootprintCheck footprint(
      lattice_planner::parseFootprint("[[0.3, 0.4], [-0.3, 0.4], [-0.3, -0.4], [0.3, -0.4]]"), false);
  footprint.reset(scene.view());
  EXPECT_FALSE(firstConflict(straight(), scene.view(), 10.0, 20.0));
  const auto conflict = firstConflict(straight(), scene.view(), 10.0, 20.0, &footprint);
  ASSERT_TRUE(conflict);
  EXPECT_FALSE(conflict->with_people);
  EXPECT_NEAR(conflict->where.x, 0.7, 0.2) << "its nose is there first";
}

TEST(PlanConflict, leavingTheMapIsOne) {
  DrawnScene scene(kFree);
  EXPECT_TRUE(firstConflict({{{1.0, 0.3, 0.0, 0.5, 0.0, 0.0}, {3.5, 0.3, 0.0, 0.5, 0.0, 5.0}}}, scene.view(),
                            0.0, 9.0));
}

}  // namespace
}  // namespace sarn_navigation
