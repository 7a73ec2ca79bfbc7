// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/people_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sarn_perception/people_perception.h"
#include "small_world.h"

namespace sarn_perception {
namespace {

constexpr double kPeriod = 1.0 / 30.0;  // [s]

/// A sensor at the origin that looks ahead over 1 rad and sees everything up to `range` [m].
RangeProfile ahead(float range) {
  RangeProfile profile;
  profile.angle_min = -0.5;
  profile.angle_increment = 0.01;
  profile.max_range = 10.0;
  profile.ranges.assign(101, range);
  return profile;
}

std::vector<Leg> pairAt(const Eigen::Vector2d& place) {
  return {{place + Eigen::Vector2d(0.0, 0.09), 0.01}, {place - Eigen::Vector2d(0.0, 0.09), 0.01}};
}

class PeopleTrackerTest : public ::testing::Test {
 protected:
  /// Somebody walks along x from `from` for `duration` [s] in full view.
  void walk(const Eigen::Vector2d& from, double speed, double duration) {
    const double start = time_;
    while (time_ - start < duration) {
      time_ += kPeriod;
      const Eigen::Vector2d place = from + Eigen::Vector2d(speed * (time_ - start), 0.0);
      tracker_.addLegs(pairAt(place), ahead(static_cast<float>(place.norm())), {}, time_);
    }
  }
  /// Nothing is detected for `duration` [s].
  void lookAway(double duration, const RangeProfile& profile, const sarn::Pose2D& sensor = {}) {
    for (const double end = time_ + duration; time_ < end;) {
      time_ += kPeriod;
      tracker_.addLegs({}, profile, sensor, time_);
    }
  }

  /// Reports people as long as it keeps them, so that tests see what becomes of them.
  static TrackerParams talkative() {
    TrackerParams params;
    params.report_sigma = params.max_sigma;
    return params;
  }

  PeopleTracker tracker_{talkative()};
  double time_ = 100.0;  // [s]
};

TEST_F(PeopleTrackerTest, reportsAWalkerWithItsVelocity) {
  walk({2.0, 0.0}, 0.8, 1.5);
  const auto people = tracker_.people();
  ASSERT_EQ(people.size(), 1U);
  EXPECT_NEAR(people[0].filter.position().x(), 2.0 + 0.8 * 1.5, 0.05);
  EXPECT_NEAR(people[0].filter.velocity().x(), 0.8, 0.08);
  EXPECT_NEAR(people[0].filter.velocity().y(), 0.0, 0.05);
  EXPECT_EQ(people[0].id, 1U);
}

TEST_F(PeopleTrackerTest, oneScanConvincesNobody) {
  tracker_.addLegs(pairAt({2.0, 0.0}), ahead(2.0F), {}, time_);
  EXPECT_TRUE(tracker_.people().empty());
  tracker_.addLegs(pairAt({2.0, 0.0}), ahead(2.0F), {}, time_ + kPeriod);
  EXPECT_EQ(tracker_.people().size(), 1U);
}

TEST_F(PeopleTrackerTest, forgetsWhoIsSeenToBeGoneWithinASecond) {
  walk({2.0, 0.0}, 0.0, 1.0);
  lookAway(0.9, ahead(8.0F));
  EXPECT_TRUE(tracker_.people().empty());
}

TEST_F(PeopleTrackerTest, saysHowReliableItsMemoryIs) {
  walk({2.0, 0.0}, 0.8, 1.5);
  const PersonTrack seen = tracker_.people().front();
  EXPECT_NEAR(seen.reliability(), seen.existence, 1e-3) << "the place is as good as known";
  lookAway(1.5, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  ASSERT_EQ(tracker_.people().size(), 1U);
  const PersonTrack remembered = tracker_.people().front();
  const double sigma = remembered.filter.positionSigma();
  EXPECT_NEAR(remembered.reliability(),
              remembered.existence * (1.0 - std::exp(-0.25 / (2.0 * sigma * sigma))), 1e-9);
  EXPECT_LT(remembered.reliability(), 0.8 * seen.reliability());
}

TEST_F(PeopleTrackerTest, outOfViewIsNoEvidenceOfAbsence) {
  walk({2.0, 0.0}, 0.0, 1.0);
  const double sure = tracker_.people().front().filter.positionSigma();
  lookAway(1.0, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  ASSERT_EQ(tracker_.people().size(), 1U);
  EXPECT_GT(tracker_.people().front().filter.positionSigma(), 1.5 * sure) << "less certain meanwhile";
  lookAway(30.0, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  EXPECT_TRUE(tracker_.tracks().empty()) << "not for ever";
}

TEST_F(PeopleTrackerTest, remembersWhoStandsWhereNobodyLooks) {
  PeopleTracker shipped{{}};
  std::swap(shipped, tracker_);
  walk({2.0, 0.0}, 0.0, 1.5);
  const std::uint64_t id = tracker_.people().front().id;
  lookAway(15.0, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  ASSERT_EQ(tracker_.people().size(), 1U) << "stands there still, for all that is known";
  const PersonTrack& there = tracker_.tracks().front();
  EXPECT_NEAR((there.filter.position() - Eigen::Vector2d(2.0, 0.0)).norm(), 0.0, 0.05);
  EXPECT_EQ(there.filter.velocity().norm(), 0.0);
  EXPECT_GT(there.filter.positionSigma(), 0.2) << "less certain meanwhile";
  walk({2.0, 0.0}, 0.8, 1.5);
  ASSERT_EQ(tracker_.people().size(), 1U);
  EXPECT_EQ(tracker_.people().front().id, id) << "and walks off as the same person";
  EXPECT_NEAR(tracker_.people().front().filter.velocity().x(), 0.8, 0.1);
}

TEST_F(PeopleTrackerTest, forgetsWhoStoodOnceTheirPlaceIsSeenEmpty) {
  walk({2.0, 0.0}, 0.0, 1.5);
  lookAway(10.0, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  ASSERT_EQ(tracker_.people().size(), 1U);
  lookAway(0.4, ahead(8.0F));
  EXPECT_TRUE(tracker_.people().empty());
}

TEST_F(PeopleTrackerTest, remembersNobodyAsStandingWhoWalkedAtLast) {
  PeopleTracker shipped{{}};
  std::swap(shipped, tracker_);
  walk({2.0, 0.0}, 0.0, 2.0);
  ASSERT_TRUE(tracker_.tracks().front().standing);
  walk({2.0, 0.0}, 0.8, 0.3);
  EXPECT_FALSE(tracker_.tracks().front().standing) << "set off";
  walk({2.24, 0.0}, 0.8, 1.5);
  EXPECT_FALSE(tracker_.tracks().front().standing);
  lookAway(5.0, ahead(8.0F), {0.0, 0.0, sarn::kPi});
  EXPECT_TRUE(tracker_.people().empty()) << "may be anywhere by now";
}

TEST_F(PeopleTrackerTest, takesNobodyForStandingAtFirstSight) {
  walk({2.0, 0.0}, 0.0, 0.4);
  EXPECT_FALSE(tracker_.tracks().front().standing);
}

/// Who turns or waits for a moment does not stay; out of view they were ghosts for many seconds.
TEST_F(PeopleTrackerTest, takesNobodyForStandingWhoMovesSlowly) {
  walk({2.0, 0.0}, 0.24, 1.0);
  for (double way = 0.24; way < 1.0; way += 0.24 * 0.1) {
    walk({2.0 + way, 0.0}, 0.24, 0.1);
    ASSERT_EQ(tracker_.tracks().size(), 1U);
    EXPECT_FALSE(tracker_.tracks().front().standing) << way;
  }
}

TEST_F(PeopleTrackerTest, walksOnBehindAnother) {
  walk({2.0, 0.0}, 0.8, 1.0);
  lookAway(0.8, ahead(1.0F));  // somebody stands before the camera
  const auto people = tracker_.people();
  ASSERT_EQ(people.size(), 1U);
  EXPECT_NEAR(people[0].filter.position().x(), 2.0 + 0.8 * 1.8, 0.15);
  walk({2.0 + 0.8 * 1.8, 0.0}, 0.8, 0.5);
  ASSERT_EQ(tracker_.people().size(), 1U);
  EXPECT_EQ(tracker_.people().front().id, people[0].id) << "the same person comes out";
}

TEST_F(PeopleTrackerTest, keepsTwoWhoPassEachOtherApart) {
  std::uint64_t first = 0;
  for (int i = 0; i < 90; ++i) {
    time_ += kPeriod;
    const double way = 1.0 * i * kPeriod;
    std::vector<Leg> legs = pairAt({1.5 + way, 0.35});
    for (const Leg& leg : pairAt({4.5 - way, -0.35})) legs.push_back(leg);
    tracker_.addLegs(legs, ahead(5.0F), {}, time_);
    if (i == 10) first = tracker_.people().front().id;
  }
  const auto people = tracker_.people();
  ASSERT_EQ(people.size(), 2U);
  for (const auto& person : people) {
    const bool is_first = person.id == first;
    EXPECT_GT(person.filter.velocity().x() * (is_first ? 1.0 : -1.0), 0.5) << "nobody turned back";
  }
}

TEST_F(PeopleTrackerTest, fusesLegsAndTorsoIntoOnePerson) {
  for (int i = 0; i < 10; ++i) {
    time_ += kPeriod;
    tracker_.addBodies({{{2.02, 0.0}, 0.02, 1.0}}, ahead(2.0F), {}, time_);
    tracker_.addLegs(pairAt({2.0, 0.0}), ahead(2.0F), {}, time_);
  }
  ASSERT_EQ(tracker_.tracks().size(), 1U);
  EXPECT_GT(tracker_.tracks()[0].seen_by[0], 5);
  EXPECT_GT(tracker_.tracks()[0].seen_by[1], 5);
}

TEST_F(PeopleTrackerTest, refusesWhatIsTooOldOrTwice) {
  walk({2.0, 0.0}, 0.0, 1.0);
  EXPECT_FALSE(tracker_.addLegs({}, ahead(8.0F), {}, time_)) << "the same scan again";
  EXPECT_FALSE(tracker_.addBodies({}, ahead(8.0F), {}, time_ - 1.0)) << "a second old";
  EXPECT_TRUE(tracker_.addBodies({}, ahead(8.0F), {}, time_ - 0.05)) << "a little late";
  EXPECT_DOUBLE_EQ(tracker_.now(), time_);
}

TEST_F(PeopleTrackerTest, doesNotSendPeopleThroughWalls) {
  tracker_.setBlocked([](const Eigen::Vector2d& p) { return p.x() > 3.2; });
  walk({2.0, 0.0}, 0.8, 1.2);
  lookAway(2.0, ahead(1.0F));
  for (const auto& track : tracker_.tracks()) EXPECT_LT(track.filter.position().x(), 3.4);
}

TEST_F(PeopleTrackerTest, isTheSameInATurnedWorld) {
  PeopleTracker turned{{}};
  const sarn::Pose2D other{3.0, -1.0, 2.2};
  for (int i = 1; i <= 30; ++i) {
    const double stamp = 10.0 + i * kPeriod;
    const Eigen::Vector2d place(2.0 + 0.5 * i * kPeriod, 0.3);
    std::vector<Leg> legs = pairAt(place);
    tracker_.addLegs(legs, ahead(2.0F), {}, stamp);
    for (Leg& leg : legs) leg.position = other * leg.position;
    turned.addLegs(legs, ahead(2.0F), other, stamp);
  }
  ASSERT_EQ(tracker_.people().size(), 1U);
  ASSERT_EQ(turned.people().size(), 1U);
  const Eigen::Vector2d moved = other * tracker_.people()[0].filter.position();
  EXPECT_NEAR((moved - turned.people()[0].filter.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(turned.people()[0].existence, tracker_.people()[0].existence, 1e-12);
}

/// A robot that turns on the spot in a room, with what its scans show.
class TurningRobotTest : public ::testing::Test {
 protected:
  TurningRobotTest() { perception_.setMap(room()); }
  void turn(const std::vector<Disc>& discs, double duration) {
    for (double t = 0.0; t < duration; t += kPeriod) {
      time_ += kPeriod;
      pose_.theta = sarn::wrapAngle(pose_.theta + 1.0 * kPeriod);
      perception_.takeScan(scanOf(pose_, discs, 640, 1.02), {pose_, {0.04, -0.03, 0.02}}, time_);
      most_ = std::max(most_, perception_.tracker().people().size());
    }
  }
  PeoplePerception perception_{{}};
  sarn::Pose2D pose_{2.5, 3.0, 0.0};
  double time_ = 1.0;
  std::size_t most_ = 0;
};

TEST_F(TurningRobotTest, makesNoPeopleOfWalls) {
  turn({}, 13.0);
  EXPECT_EQ(most_, 0U);
}

TEST_F(TurningRobotTest, seesThatWhoStandsDoesNotMove) {
  turn(legsAt({4.0, 3.0}), 0.4);
  const auto people = perception_.tracker().people();
  ASSERT_EQ(people.size(), 1U);
  EXPECT_LT(people[0].filter.velocity().norm(), 0.1) << "a turning robot moves nobody";
  turn(legsAt({4.0, 3.0}), 6.1);
  EXPECT_EQ(most_, 1U);
}

}  // namespace
}  // namespace sarn_perception
