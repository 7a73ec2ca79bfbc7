// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sarn_tests {
namespace {

TruePerson person(int id, double x, bool visible = true) { return {id, {x, 0.0}, {1.0, 0.0}, visible}; }
ReportedPerson report(std::uint64_t id, double x, double age = 1.0) {
  return {id, {x, 0.0}, {1.0, 0.0}, age};
}

TEST(TrackingScore, countsRightMissedAndWrong) {
  TrackingScore score;
  score.add({person(0, 0.0), person(1, 5.0)}, {report(7, 0.1), report(8, 9.0)}, 0.0, false);
  EXPECT_DOUBLE_EQ(score.precision(), 0.5);
  EXPECT_DOUBLE_EQ(score.recall(), 0.5);
  EXPECT_DOUBLE_EQ(score.mota(), 0.0) << "1 - (1 missed + 1 wrong) / 2";
  EXPECT_DOUBLE_EQ(score.motp(), 0.1);
}

TEST(TrackingScore, asksForNobodyWhoIsHiddenButBlamesGhosts) {
  TrackingScore score;
  score.add({person(0, 0.0, false)}, {report(7, 0.1), report(8, 3.0)}, 0.0, false);
  EXPECT_EQ(score.moments(), 0);
  EXPECT_DOUBLE_EQ(score.precision(), 0.0) << "one wrong, the other neither right nor wrong";
}

TEST(TrackingScore, countsASwitchOnce) {
  TrackingScore score;
  score.add({person(0, 0.0)}, {report(7, 0.0)}, 0.0, false);
  score.add({person(0, 0.1)}, {report(7, 0.4), report(9, 0.1)}, 0.1, false);
  EXPECT_EQ(score.switches(), 0) << "a match is kept while it holds";
  score.add({person(0, 0.2)}, {report(9, 0.2)}, 0.2, false);
  score.add({person(0, 0.3)}, {report(9, 0.3)}, 0.3, false);
  EXPECT_EQ(score.switches(), 1);
}

TEST(TrackingScore, measuresTheVelocityAsAVector) {
  TrackingScore score;
  ReportedPerson fast = report(7, 0.0, 0.1);
  fast.velocity = {1.3, 0.4};
  score.add({person(0, 0.0)}, {fast}, 0.0, true);
  EXPECT_NEAR(score.velocityRmse(), 0.5, 1e-12);
  EXPECT_NEAR(score.velocityRmseTurning(), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(score.velocityRmseSettled(), 0.0) << "seen for 0.1 s only";
}

TEST(TrackingScore, timesGhostsButNotThoseWhoWereOnceRight) {
  TrackingScore score;
  score.add({person(0, 0.0)}, {report(7, 0.0), report(8, 5.0)}, 1.0, false);
  score.add({person(0, 9.0)}, {report(7, 0.0), report(8, 5.0)}, 1.7, false);
  EXPECT_NEAR(score.longestGhost(), 0.7, 1e-12);
  score.nextRun();
  score.add({}, {report(8, 5.0)}, 9.0, false);
  EXPECT_NEAR(score.longestGhost(), 0.7, 1e-12);
}

}  // namespace
}  // namespace sarn_tests
