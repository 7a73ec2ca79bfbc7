// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "drawn_scene.h"
#include "lattice_planner/trajectory_cost.h"

namespace sarn_navigation {
namespace {

constexpr double kPeriod = 0.05;  // [s]

lattice_planner::PlannerParams plannerParams() {
  lattice_planner::PlannerParams params;
  params.max_expansions = 20000;  // the same answer on any machine
  params.table_radius = 0.6;      // built once a test, also under slow sanitizers
  return params;
}

/// A perfect robot in a drawn world, driven by the navigator; plans are waited for, so that tests repeat.
class Drive {
 public:
  Drive(DrawnScene& scene, const sarn::Pose2D& start, const NavigatorParams& params = {},
        CostFunction cost = {})
      : scene_(scene),
        pose_(start),
        planner_(std::make_shared<lattice_planner::LatticePlanner>(plannerParams())),
        navigator_(
            params, {},
            [this](const auto& request, const auto& view) { return planner_->plan(request, view); },
            std::move(cost)) {}

  NavigatorInput input() { return {now_, pose_, twist_, scene_.shared()}; }
  std::string setGoal(const sarn::Pose2D& goal) { return navigator_.setGoal(goal, input()); }
  void step() {
    twist_ = navigator_.step(input());
    pose_ = sarn::advance(pose_, twist_, kPeriod);
    now_ += kPeriod;
    navigator_.waitForPlanDue(now_ + 1.0);
  }
  /// Steps until the state is reached; false after the time limit [s].
  bool runUntil(NavigatorState state, double limit) {
    for (const double end = now_ + limit; now_ < end;) {
      step();
      if (navigator_.status().state == state) return true;
    }
    return false;
  }
  Navigator& navigator() { return navigator_; }
  [[nodiscard]] const sarn::Pose2D& pose() const { return pose_; }
  [[nodiscard]] const sarn::Twist2D& twist() const { return twist_; }
  [[nodiscard]] double now() const { return now_; }

 private:
  DrawnScene& scene_;
  sarn::Pose2D pose_;
  sarn::Twist2D twist_;
  double now_ = 100.0;
  std::shared_ptr<lattice_planner::LatticePlanner> planner_;
  Navigator navigator_;
};

std::vector<std::string> room(int width, int height) {
  return std::vector<std::string>(static_cast<std::size_t>(height),
                                  std::string(static_cast<std::size_t>(width), '.'));
}

TEST(Navigator, drivesToItsGoalAndStops) {
  DrawnScene scene(room(24, 12));
  Drive drive(scene, {0.6, 0.6, 0.0});
  ASSERT_EQ(drive.setGoal({4.5, 2.0, 1.57}), "");
  EXPECT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 40.0));
  EXPECT_NEAR(drive.pose().x, 4.5, 0.2);
  EXPECT_NEAR(drive.pose().y, 2.0, 0.2);
  EXPECT_NEAR(drive.pose().theta, 1.57, 0.25);
  EXPECT_FALSE(drive.navigator().hasGoal());
}

TEST(Navigator, refusesGoalsThatCannotBeReachedAndSaysWhy) {
  DrawnScene scene({".....", "..#?.", "....."});
  Drive drive(scene, {0.1, 0.1, 0.0});
  const auto expectRefused = [&drive](const sarn::Pose2D& goal, const char* why,
                                      lattice_planner::PlanStatus status) {
    EXPECT_NE(drive.setGoal(goal).find(why), std::string::npos) << why;
    EXPECT_EQ(drive.navigator().status().plan_status, status) << why;
  };
  expectRefused({9.0, 0.0, 0.0}, "outside the map", lattice_planner::PlanStatus::kGoalOutsideMap);
  expectRefused({0.6, 0.4, 0.0}, "in an obstacle", lattice_planner::PlanStatus::kGoalOccupied);
  expectRefused({0.9, 0.4, 0.0}, "unknown space", lattice_planner::PlanStatus::kGoalUnknown);
  expectRefused({std::nan(""), 0.4, 0.0}, "not finite", lattice_planner::PlanStatus::kInvalidRequest);
  EXPECT_FALSE(drive.navigator().hasGoal());
}

TEST(Navigator, brakesBeforeAnObstacleThatAppearsOnThePlan) {
  DrawnScene scene(room(32, 3));
  Drive drive(scene, {0.6, 0.37, 0.0});
  ASSERT_EQ(drive.setGoal({7.0, 0.37, 0.0}), "");
  while (drive.pose().x < 2.0) drive.step();
  ASSERT_GT(drive.twist().v, 0.3);
  std::vector<std::string> walled = room(32, 3);
  for (auto& row : walled) row[13] = '#';  // x in [3.25, 3.5]
  DrawnScene blocked(walled);
  scene.view() = blocked.view();
  for (int i = 0; i < 100; ++i) drive.step();
  EXPECT_LT(drive.pose().x, 3.25);
}

TEST(Navigator, givesUpAfterItsRecoveriesWithAReason) {
  DrawnScene scene({"....#.........", "....#.........", "....#.........", "....#........."});
  NavigatorParams params;
  params.progress_timeout = 1.0;
  params.recovery_wait = 0.1;
  params.recovery_turn_speed = 3.0;
  params.max_recoveries = 2;
  Drive drive(scene, {0.5, 0.5, 0.0}, params);
  ASSERT_EQ(drive.setGoal({3.0, 0.5, 0.0}), "");
  EXPECT_TRUE(drive.runUntil(NavigatorState::kAborted, 60.0));
  EXPECT_NE(drive.navigator().status().reason.find("after 2 recoveries"), std::string::npos);
  EXPECT_EQ(drive.twist().v, 0.0);
}

TEST(Navigator, doesNotTurnToRecoverWhereItsOutlineHasNoRoom) {
  for (const bool is_long : {true, false}) {
    DrawnScene scene(
        {"###############", "....#..........", "....#..........", "....#..........", "###############"});
    NavigatorParams params;
    params.progress_timeout = 1.0;
    params.recovery_wait = 0.1;
    params.max_recoveries = 1;
    lattice_planner::Footprint footprint;
    if (is_long)
      footprint = lattice_planner::parseFootprint("[[0.45, 0.2], [-0.45, 0.2], [-0.45, -0.2], [0.45, -0.2]]");
    Navigator navigator(params, {},
                        [](const auto&, const auto&) {
                          lattice_planner::PlanResult none;
                          none.status = lattice_planner::PlanStatus::kNoPath;
                          return none;
                        },
                        {}, {footprint, false});
    const sarn::Pose2D pose{0.5, 0.6, 0.0};
    ASSERT_EQ(navigator.setGoal({3.0, 0.6, 0.0}, {100.0, pose, {}, scene.shared()}), "");
    bool turned = false;
    for (double now = 100.0; navigator.hasGoal() && now < 160.0; now += kPeriod) {
      turned = navigator.step({now, pose, {}, scene.shared()}).omega != 0.0 || turned;
    }
    EXPECT_EQ(turned, !is_long);
    EXPECT_EQ(navigator.status().state, NavigatorState::kAborted);
  }
}

TEST(Navigator, controlsWhileASearchRuns) {
  DrawnScene scene(room(32, 8));
  std::promise<void> release;
  const auto released = release.get_future().share();
  lattice_planner::LatticePlanner planner(plannerParams());
  int searches = 0;
  Navigator navigator({}, {}, [&](const auto& request, const auto& view) {
    if (++searches == 2) released.wait();  // a search that takes as long as it likes
    return planner.plan(request, view);
  });
  sarn::Pose2D pose{0.6, 1.0, 0.0};
  sarn::Twist2D twist;
  double now = 100.0;
  const auto step = [&] {
    twist = navigator.step({now, pose, twist, scene.shared()});
    pose = sarn::advance(pose, twist, kPeriod);
    now += kPeriod;
  };
  ASSERT_EQ(navigator.setGoal({7.0, 1.0, 0.0}, {now, pose, twist, scene.shared()}), "");
  step();
  navigator.waitForPlanDue(now + 1.0);   // the first
  for (int i = 0; i < 100; ++i) step();  // 5 s
  EXPECT_GT(pose.x, 2.0) << "drives its plan on";
  release.set_value();
}

TEST(Navigator, movesAsideForSomebodyWhoseWayItBlocksAndStaysCalmOtherwise) {
  DrawnScene scene(room(24, 16));
  Drive drive(scene, {3.0, 2.0, 0.0});
  for (int i = 0; i < 20; ++i) drive.step();
  EXPECT_EQ(drive.navigator().status().state, NavigatorState::kIdle);
  drive.navigator().observe({drive.now(), 0.5, {{"anna", "", {{{5.5, 2.0}, {-1.0, 0.0}, 0.1}}}}});
  ASSERT_TRUE(drive.runUntil(NavigatorState::kYielding, 2.0));
  EXPECT_NE(drive.navigator().status().reason.find("anna"), std::string::npos);
  for (int i = 0; i < 120; ++i) drive.step();
  EXPECT_GT(std::abs(drive.pose().y - 2.0), NavigatorParams().yield_distance) << "out of the person's line";
}

/// What the planner minimises, as the node gives it to the navigator.
double planCost(const sarn::TimedTrajectory& trajectory, const sarn::TimedCostmapView& view, double from) {
  return lattice_planner::trajectoryCost(plannerParams(), trajectory, view, from);
}

TEST(Navigator, keepsThePlanItDrivesWhileNoneIsClearlyCheaper) {
  DrawnScene scene(room(32, 8));
  Drive drive(scene, {0.6, 1.0, 0.0}, {}, planCost);
  ASSERT_EQ(drive.setGoal({7.0, 1.0, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kDriving, 5.0));
  ASSERT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 30.0));
  EXPECT_EQ(drive.navigator().planCount(), 1U) << "nothing changed: the first plan was driven to its end";
}

TEST(Navigator, withoutACostFunctionEveryPlanIsTakenOver) {
  DrawnScene scene(room(32, 8));
  Drive drive(scene, {0.6, 1.0, 0.0});
  ASSERT_EQ(drive.setGoal({7.0, 1.0, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 30.0));
  EXPECT_GT(drive.navigator().planCount(), 10U);
}

TEST(Navigator, leavesThePlanForAClearlyCheaperOne) {
  std::vector<std::string> dear = room(32, 12);  // a dear band in the middle, which leaves the edges free
  DrawnScene scene(dear);
  Drive drive(scene, {0.6, 1.5, 0.0}, {}, planCost);
  ASSERT_EQ(drive.setGoal({7.0, 1.5, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kDriving, 5.0));
  const unsigned before = drive.navigator().planCount();
  for (std::size_t row = 4; row < 8; ++row) {
    for (std::size_t x = 12; x < 22; ++x) dear[row][x] = '9';  // y in [1, 2], x in [3, 5.5]
  }
  DrawnScene changed(dear);
  scene.view() = changed.view();
  for (int i = 0; i < 40; ++i) drive.step();
  EXPECT_GT(drive.navigator().planCount(), before);
}

TEST(Navigator, thePlanToTheLastGoalIsNotKeptForANewOneHoweverCheapItIs) {
  DrawnScene scene(room(32, 8));
  Drive drive(scene, {0.6, 1.0, 0.0}, {}, planCost);
  ASSERT_EQ(drive.setGoal({3.0, 1.0, 0.0}), "");
  while (drive.pose().x < 1.5) drive.step();
  ASSERT_EQ(drive.setGoal({7.0, 1.0, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 30.0));
  EXPECT_NEAR(drive.pose().x, 7.0, 0.2);
}

TEST(Navigator, stillMovesAsideForSomebodyItHasLostFromSight) {
  DrawnScene scene(room(24, 16));
  Drive drive(scene, {3.0, 2.0, 0.0});
  drive.navigator().observe({drive.now(), 0.5, {{"anna", "", {{{5.5, 2.0}, {-1.0, 0.0}, 0.1}}}}});
  ASSERT_TRUE(drive.runUntil(NavigatorState::kYielding, 2.0));
  for (int i = 0; i < 60; ++i) {
    drive.step();
    drive.navigator().observe({drive.now(), 0.5, {}});  // turned away from her
    ASSERT_EQ(drive.navigator().status().state, NavigatorState::kYielding) << "after " << i << " steps";
  }
  EXPECT_TRUE(drive.runUntil(NavigatorState::kIdle, NavigatorParams().yield_timeout)) << "but not for ever";
}

TEST(Navigator, aGoalThatComesWhileItMovesAsideWaitsForThePerson) {
  DrawnScene scene(room(24, 16));
  Drive drive(scene, {3.0, 2.0, 0.0}, {}, planCost);
  drive.navigator().observe({drive.now(), 0.5, {{"anna", "", {{{5.5, 2.0}, {-1.0, 0.0}, 0.1}}}}});
  ASSERT_TRUE(drive.runUntil(NavigatorState::kYielding, 5.0));
  ASSERT_EQ(drive.setGoal({5.4, 2.0, 0.0}), "");
  drive.step();
  EXPECT_EQ(drive.navigator().status().state, NavigatorState::kYielding);
  drive.navigator().observe({drive.now(), 0.5, {{"anna", "", {{{1.5, 2.0}, {-1.0, 0.0}, 0.1}}}}});
  drive.step();
  EXPECT_EQ(drive.navigator().status().state, NavigatorState::kPlanning) << "she has passed";
}

TEST(Navigator, expectsPeopleToWaitWhileItMovesAside) {
  DrawnScene scene(room(24, 16));
  Drive drive(scene, {3.0, 2.0, 0.0});
  const sarn::PeoplePrediction people{
      drive.now(), 1.0, {{"anna", "", {{{5.5, 2.0}, {-1.0, 0.0}, 0.1}, {{2.0, 2.0}, {-1.0, 0.0}, 0.1}}}}};
  EXPECT_EQ(drive.navigator().expected(people).people[0].states[1].position.x(), 2.0);
  EXPECT_FALSE(drive.navigator().takeExpectationChange());
  drive.navigator().observe(people);
  ASSERT_TRUE(drive.runUntil(NavigatorState::kYielding, 2.0));
  EXPECT_TRUE(drive.navigator().takeExpectationChange());
  EXPECT_EQ(drive.navigator().expected(people).people[0].states[1].position.x(), 5.5);
}

TEST(Navigator, goalThatIsSetWhileItMovesAsideIsReachedItself) {
  DrawnScene scene(room(24, 16));
  Drive drive(scene, {3.0, 2.0, 0.0}, {}, planCost);
  drive.navigator().observe({drive.now(), 0.5, {{"anna", "", {{{5.5, 2.0}, {-1.0, 0.0}, 0.1}}}}});
  ASSERT_TRUE(drive.runUntil(NavigatorState::kYielding, 5.0));
  for (int i = 0; i < 10; ++i) drive.step();
  drive.navigator().observe({drive.now(), 0.5, {}});
  ASSERT_EQ(drive.setGoal({5.4, 2.0, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 40.0));
  EXPECT_NEAR(drive.pose().x, 5.4, 0.2);
  EXPECT_NEAR(drive.pose().y, 2.0, 0.2);
}

TEST(Navigator, aGoalWithoutAPlanIsNotReachedAtTheLastOne) {
  std::vector<std::string> rooms = room(32, 8);
  for (auto& row : rooms) row[24] = '#';
  DrawnScene scene(rooms);
  NavigatorParams params;
  params.max_recoveries = 0;
  params.progress_timeout = 3.0;
  Drive drive(scene, {0.6, 1.0, 0.0}, params, planCost);
  ASSERT_EQ(drive.setGoal({3.0, 1.0, 0.0}), "");
  while (drive.pose().x < 1.5) drive.step();
  ASSERT_EQ(drive.setGoal({7.5, 1.0, 0.0}), "");  // behind the wall
  EXPECT_FALSE(drive.runUntil(NavigatorState::kSucceeded, 12.0));
  EXPECT_EQ(drive.navigator().status().state, NavigatorState::kAborted);
}

TEST(Navigator, aPlanThatIsBlockedIsNotKept) {
  DrawnScene scene(room(32, 8));
  Drive drive(scene, {0.6, 1.0, 0.0}, {}, planCost);
  ASSERT_EQ(drive.setGoal({7.0, 1.0, 0.0}), "");
  ASSERT_TRUE(drive.runUntil(NavigatorState::kDriving, 5.0));
  std::vector<std::string> walled = room(32, 8);
  for (std::size_t row = 2; row < 8; ++row) walled[row][20] = '#';  // free above y = 1.5
  DrawnScene blocked(walled);
  scene.view() = blocked.view();
  ASSERT_TRUE(drive.runUntil(NavigatorState::kSucceeded, 60.0));
  EXPECT_GT(drive.navigator().planCount(), 1U);
}

TEST(Navigator, cancelStopsWithinTheAccelerationLimit) {
  DrawnScene scene(room(32, 4));
  Drive drive(scene, {0.6, 0.5, 0.0});
  ASSERT_EQ(drive.setGoal({7.0, 0.5, 0.0}), "");
  while (drive.twist().v < 0.45) drive.step();
  drive.navigator().cancel();
  double last = drive.twist().v;
  while (last > 0.0) {
    drive.step();
    EXPECT_GE(drive.twist().v, last - NavigatorParams().acc_lim_x * kPeriod - 1e-9);
    ASSERT_LT(drive.twist().v, last);
    last = drive.twist().v;
  }
}

}  // namespace
}  // namespace sarn_navigation
