// SPDX-License-Identifier: BSD-3-Clause
// What single people do: timetable, recording, social force, gait.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>

#include "kobuki_sim/people/gait.h"
#include "kobuki_sim/people/itinerary.h"
#include "kobuki_sim/people/recording.h"
#include "kobuki_sim/people/social_force.h"
#include "kobuki_sim/random.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> straight(const Vector2d& a, const Vector2d& b) { return {a, b}; }

Vector2d placeAt(OnArrival on_arrival, double time) {
  const Itinerary itinerary = makeItinerary({0.0, 0.0}, {{2.0, 0.0}, {2.0, 1.0}}, on_arrival, straight);
  return timetablePoint(itinerary, {0.0, 0.0}, 0.5, time).position;
}

TEST(Timetable, keepsConstantSpeedAlongTheLegs) {
  EXPECT_TRUE(placeAt(OnArrival::kStop, 2.0).isApprox(Vector2d(1.0, 0.0)));
  EXPECT_TRUE(placeAt(OnArrival::kStop, 5.0).isApprox(Vector2d(2.0, 0.5)));
  EXPECT_TRUE(placeAt(OnArrival::kStop, -1.0).isZero());
}

TEST(Timetable, staysAtTheLastWaypointOrGoesOn) {
  // 3 m take 6 s; what a person does after 7 s shows what happens on arrival.
  EXPECT_TRUE(placeAt(OnArrival::kStop, 7.0).isApprox(Vector2d(2.0, 1.0)));
  EXPECT_TRUE(placeAt(OnArrival::kLoop, 7.0).isApprox(Vector2d(2.0, 0.5)));  // back to the first waypoint
  EXPECT_TRUE(placeAt(OnArrival::kLoop, 9.0).isApprox(Vector2d(2.0, 0.5)));  // and to the second again
  EXPECT_TRUE(placeAt(OnArrival::kReverse, 7.0).isApprox(Vector2d(2.0, 0.5)));
  EXPECT_TRUE(placeAt(OnArrival::kReverse, 10.0).isApprox(Vector2d(1.0, 0.0)));
  EXPECT_TRUE(placeAt(OnArrival::kReverse, 13.0).isApprox(Vector2d(0.5, 0.0)));
  EXPECT_TRUE(placeAt(OnArrival::kRespawn, 7.0).isApprox(Vector2d(0.5, 0.0)));
}

TEST(Timetable, loopOverOneWaypointComesBackToTheStart) {
  const Itinerary itinerary = makeItinerary({0.0, 0.0}, {{1.0, 0.0}}, OnArrival::kLoop, straight);
  EXPECT_TRUE(timetablePoint(itinerary, {0.0, 0.0}, 1.0, 1.25).position.isApprox(Vector2d(0.75, 0.0)));
  EXPECT_TRUE(timetablePoint(itinerary, {0.0, 0.0}, 1.0, 2.25).position.isApprox(Vector2d(0.25, 0.0)));
}

TEST(Timetable, velocityIsTheDerivativeOfThePosition) {
  const Itinerary itinerary =
      makeItinerary({0.0, 0.0}, {{2.0, 1.0}, {-1.0, 1.0}}, OnArrival::kReverse, straight);
  for (double t = 0.05; t < 20.0; t += 0.173) {
    const auto before = timetablePoint(itinerary, {0.0, 0.0}, 0.7, t - 1e-6).position;
    const auto after = timetablePoint(itinerary, {0.0, 0.0}, 0.7, t + 1e-6).position;
    EXPECT_LT(((after - before) / 2e-6 - timetablePoint(itinerary, {0.0, 0.0}, 0.7, t).velocity).norm(),
              1e-6);
  }
}

class RecordingTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    const auto file =
        std::filesystem::temp_directory_path() / (std::string("recording_") + info->name() + ".txt");
    std::ofstream(file) << text;
    return file;
  }
  std::string errorOf(const std::string& text) const {
    try {
      (void)loadRecording(write(text), {});
    } catch (const RecordingError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(RecordingTest, readsPeopleInAnyOrderAndInterpolates) {
  const auto people =
      loadRecording(write("# frame id x y\n10 2.0 5 5\n\n0\t1.0\t0.0\t0.0\n10,1,1.0,0.5\n30 1 1.0 2.5\n"),
                    {10.0, 0, {1.0, -1.0}});
  ASSERT_EQ(people.size(), 2U);
  EXPECT_EQ(people[0].id, "2");
  EXPECT_EQ(people[1].id, "1");
  std::size_t hint = 0;
  const auto middle = recordedState(people[1], 0.5, hint);
  ASSERT_TRUE(middle);
  EXPECT_TRUE(middle->position.isApprox(Vector2d(1.5, -0.75)));
  EXPECT_TRUE(middle->velocity.isApprox(Vector2d(1.0, 0.5)));
  const auto later = recordedState(people[1], 2.0, hint);
  ASSERT_TRUE(later);
  EXPECT_TRUE(later->velocity.isApprox(Vector2d(0.0, 1.0)));
  EXPECT_TRUE(recordedState(people[1], 0.5, hint));  // time may go back
}

TEST_F(RecordingTest, peopleAreThereOnlyWhileRecorded) {
  const auto people =
      loadRecording(write("25 1 0 0\n50 1 1 0\n500 1 2 0\n510 1 3 0\n"), {25.0, 0, Vector2d::Zero()});
  std::size_t hint = 0;
  EXPECT_FALSE(recordedState(people[0], 0.9, hint));
  EXPECT_TRUE(recordedState(people[0], 1.5, hint));
  EXPECT_FALSE(recordedState(people[0], 10.0, hint));  // a pause of 18 s
  EXPECT_TRUE(recordedState(people[0], 20.2, hint));
  EXPECT_FALSE(recordedState(people[0], 20.5, hint));
}

TEST_F(RecordingTest, startFrameIsTimeZero) {
  const auto people = loadRecording(write("100 1 0 0\n125 1 1 0\n"), {25.0, 100, Vector2d::Zero()});
  EXPECT_DOUBLE_EQ(people[0].points[0].time, 0.0);
  EXPECT_DOUBLE_EQ(people[0].points[1].time, 1.0);
}

TEST_F(RecordingTest, namesFileAndLineOfWhatIsWrong) {
  EXPECT_NE(errorOf("0 1 0 0\n10 1 zero 0\n").find("line 2: 'zero' is not a finite number"),
            std::string::npos);
  EXPECT_NE(errorOf("0 1 0\n").find("line 1: has 3 values instead of 4"), std::string::npos);
  EXPECT_NE(errorOf("0 1 0 nan\n").find("line 1: 'nan'"), std::string::npos);
  EXPECT_NE(errorOf("0 1 0 0\n0 1 1 1\n").find("person 1 has two places"), std::string::npos);
  EXPECT_NE(errorOf("# nothing\n").find("holds nobody"), std::string::npos);
  EXPECT_NE(errorOf("0 1 0 nan\n").find("recording_namesFileAndLine"), std::string::npos);
  EXPECT_THROW((void)loadRecording("/nonexistent/people.txt", {}), RecordingError);
  EXPECT_THROW((void)loadRecording(write("0 1 0 0\n"), {0.0, 0, Vector2d::Zero()}), RecordingError);
}

TEST(SocialForce, desiredForceRelaxesTowardsTheDesiredVelocity) {
  const SocialForceParams params;
  const Vector2d force = desiredForce({1.3, 0.0}, {0.3, 0.2}, params);
  EXPECT_TRUE(force.isApprox(Vector2d(1.0, -0.2) / 0.54));
}

TEST(SocialForce, interactionEqualsItsFormulaAhead) {
  const SocialForceParams params;
  // Oncoming straight ahead: D = 2 * (2, 0) + (1, 0), |D| = 5, B = 0.35 * 5, theta = 0.
  const MovingDisc self{{0.0, 0.0}, {1.0, 0.0}, 0.25};
  const MovingDisc other{{3.0, 0.0}, {-1.0, 0.0}, 0.25};
  const double expected = 4.5 * std::exp(-3.0 / (0.35 * 5.0));
  const Vector2d force = interactionForce(self, other, params);
  EXPECT_NEAR(force.x(), -expected, 1e-12);
  EXPECT_NEAR(force.y(), -expected, 1e-12);  // to the right
}

TEST(SocialForce, whoIsBehindCountsLessThanWhoIsAhead) {
  const SocialForceParams params;
  const MovingDisc self{{0.0, 0.0}, {1.0, 0.0}, 0.25};
  const double ahead = interactionForce(self, {{2.0, 0.0}, {0.0, 0.0}, 0.25}, params).norm();
  const double behind = interactionForce(self, {{-2.0, 0.0}, {0.0, 0.0}, 0.25}, params).norm();
  EXPECT_GT(ahead, 5.0 * behind);
}

TEST(SocialForce, turnsAwayFromTheSideOfTheOther) {
  const SocialForceParams params;
  const MovingDisc self{{0.0, 0.0}, {1.0, 0.0}, 0.25};
  EXPECT_LT(interactionForce(self, {{2.0, 0.3}, {-1.0, 0.0}, 0.25}, params).y(), 0.0);
  EXPECT_GT(interactionForce(self, {{2.0, -0.3}, {-1.0, 0.0}, 0.25}, params).y(), 0.0);
}

TEST(SocialForce, turnsWithTheWorld) {
  RandomStream random(1, "force");
  const SocialForceParams params;
  const auto draw = [&] { return Vector2d(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)); };
  for (int i = 0; i < 100; ++i) {
    const MovingDisc self{draw(), draw(), 0.25};
    const MovingDisc other{draw(), draw(), 0.3};
    const Vector2d direction = draw().normalized();
    const std::vector<Vector2d> fellows{draw(), draw()};
    const Eigen::Rotation2Dd turn(random.uniform(-3.0, 3.0));
    const MovingDisc turned_self{turn * self.position, turn * self.velocity, self.radius};
    const MovingDisc turned_other{turn * other.position, turn * other.velocity, other.radius};
    const Vector2d force = interactionForce(self, other, params) + contactForce(self, other, params) +
                           wallForce(self, other.position, params) +
                           groupForce(self, direction, fellows, params);
    const Vector2d turned =
        interactionForce(turned_self, turned_other, params) +
        contactForce(turned_self, turned_other, params) +
        wallForce(turned_self, turned_other.position, params) +
        groupForce(turned_self, turn * direction, {turn * fellows[0], turn * fellows[1]}, params);
    EXPECT_LT((turned - turn * force).norm(), 1e-9 * (1.0 + force.norm()));
  }
}

TEST(SocialForce, wallPushesExponentiallyFromTheRim) {
  const SocialForceParams params;
  const MovingDisc self{{0.0, 0.45}, {0.0, 0.0}, 0.25};
  EXPECT_NEAR(wallForce(self, {0.0, 0.0}, params).y(), 3.0 * std::exp(-2.0), 1e-12);
}

TEST(SocialForce, groupPullsWhoIsFarAndPartsWhoIsNear) {
  const SocialForceParams params;
  const MovingDisc self{{0.0, 0.0}, {1.0, 0.0}, 0.25};
  EXPECT_GT(groupForce(self, {1.0, 0.0}, {{3.0, 0.0}}, params).x(), 0.0);
  EXPECT_TRUE(groupForce(self, {1.0, 0.0}, {{0.9, 0.0}}, params).isZero());
  EXPECT_LT(groupForce(self, {1.0, 0.0}, {{0.5, 0.0}}, params).x(), 0.0);
  EXPECT_LT(groupForce(self, {1.0, 0.0}, {{-0.9, 0.0}}, params).x(), 0.0);  // waits for who is behind
}

TEST(Gait, stepsHaveSeventyCentimetresAtWalkingSpeed) {
  EXPECT_NEAR(stepLength(1.3), 0.7, 1e-12);
  EXPECT_LT(stepLength(0.6), 0.7);
  EXPECT_GT(stepLength(0.0), 0.0);
}

TEST(Gait, twoStepsAreOneCycle) {
  EXPECT_NEAR(advancePhase(0.0, 0.7, 1.3), sarn::kPi, 1e-12);
  EXPECT_NEAR(advancePhase(1.0, 1.4, 1.3), 1.0, 1e-9);
  EXPECT_EQ(advancePhase(1.0, 0.0, 0.0), 1.0);
}

}  // namespace
}  // namespace kobuki_sim
