// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "sarn_navigation/passing_watch.h"
#include "sarn_navigation/waiting_people.h"

namespace sarn_navigation {
namespace {

constexpr double kStep = 0.5;  // [s] of a prediction

sarn::PersonPrediction straightOn(const std::string& name, const Eigen::Vector2d& position,
                                  const Eigen::Vector2d& velocity) {
  sarn::PersonPrediction person{name, "", {}};
  for (int i = 0; i < 10; ++i) person.states.push_back({position + i * kStep * velocity, velocity, 0.1});
  return person;
}

double nearest(const sarn::PersonPrediction& person, const Eigen::Vector2d& place) {
  double result = HUGE_VAL;
  for (const auto& state : person.states) result = std::min(result, (state.position - place).norm());
  return result;
}

TEST(WaitingPeople, stopInFrontOfTheRobotInsteadOfWalkingThroughIt) {
  const Eigen::Vector2d robot(0.0, 0.0);
  const auto waiting =
      waitingInFrontOf(robot, 0.8, {1.0, kStep, {straightOn("anna", {2.0, 0.1}, {-0.6, 0.0})}});
  const auto& states = waiting.people.front().states;
  ASSERT_EQ(states.size(), 10U);
  EXPECT_GE(nearest(waiting.people.front(), robot), 0.8);
  EXPECT_NEAR(states[4].position.x(), 0.8, 1e-9) << "walks until the last place that is far enough";
  EXPECT_EQ(states[5].position, states[4].position);
  EXPECT_EQ(states.back().velocity, Eigen::Vector2d(0.0, 0.0));
}

TEST(WaitingPeople, doNotJumpOverItBetweenTwoSteps) {
  const Eigen::Vector2d robot(0.0, 0.0);
  const auto waiting =
      waitingInFrontOf(robot, 0.3, {1.0, kStep, {straightOn("anna", {1.0, 0.0}, {-4.0, 0.0})}});
  EXPECT_NEAR(waiting.people.front().states.back().position.x(), 1.0, 1e-9);
}

TEST(WaitingPeople, whoIsNearerAlreadyComesNoNearerAndMayGoAway) {
  const Eigen::Vector2d robot(0.0, 0.0);
  const auto waiting = waitingInFrontOf(
      robot, 0.8,
      {1.0,
       kStep,
       {straightOn("comes", {0.6, 0.0}, {-0.5, 0.0}), straightOn("goes", {0.6, 0.0}, {0.5, 0.0}),
        straightOn("passes", {2.0, 1.5}, {-0.5, 0.0})}});
  EXPECT_NEAR(nearest(waiting.people[0], robot), 0.6, 1e-9);
  EXPECT_NEAR(waiting.people[1].states.back().position.x(), 0.6 + 9 * 0.25, 1e-9);
  EXPECT_NEAR(waiting.people[2].states.back().position.x(), 2.0 - 9 * 0.25, 1e-9);
}

/// Anna wants along -x through a robot in the origin, with 2 m to go at 0.5 m/s.
class Passing : public testing::Test {
 protected:
  void see(double stamp, const std::string& name, double x, double speed) {
    watch_.observe({stamp, kStep, {straightOn(name, {x, 0.0}, {speed, 0.0})}});
  }
  void lose(double stamp) { watch_.observe({stamp, kStep, {}}); }

  PassingWatch watch_{{"anna", {2.0, 0.0}, {-0.5, 0.0}}, {0.0, 0.0}, 10.0};
};

TEST_F(Passing, whoIsInSightIsJudgedBySight) {
  see(10.1, "anna", 1.9, -0.5);
  EXPECT_FALSE(watch_.mayStillCome(10.1));
  EXPECT_FALSE(watch_.seenBeyond());
  see(16.0, "anna", -1.0, -0.5);
  EXPECT_TRUE(watch_.seenBeyond());
}

TEST_F(Passing, whoIsLostFromSightStillComesUntilTheyHadTheTime) {
  lose(11.0);
  EXPECT_TRUE(watch_.mayStillCome(40.0)) << "the robot still blocks the way";
  watch_.robotIsAside(15.0);
  EXPECT_TRUE(watch_.mayStillCome(20.0)) << "2.9 m at 0.5 m/s take 5.8 s";
  EXPECT_FALSE(watch_.mayStillCome(30.0));
}

TEST_F(Passing, whoIsSeenBeyondHasPassedWhateverTheNameIs) {
  lose(11.0);
  see(12.0, "person_7", -1.5, 0.5);
  EXPECT_FALSE(watch_.seenBeyond()) << "walks the other way";
  see(13.0, "person_7", -1.5, 0.0);
  EXPECT_FALSE(watch_.seenBeyond()) << "stands there";
  see(14.0, "person_8", -1.5, -0.5);
  EXPECT_TRUE(watch_.seenBeyond());
  EXPECT_FALSE(watch_.mayStillCome(14.0));
}

}  // namespace
}  // namespace sarn_navigation
