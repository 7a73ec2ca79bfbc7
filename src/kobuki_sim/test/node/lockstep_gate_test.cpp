// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/lockstep_gate.h"

#include <gtest/gtest.h>

namespace kobuki_sim {
namespace {

constexpr std::int64_t kMillisecond = 1000000;

TEST(LockstepGate, isOpenWithoutParticipants) {
  LockstepGate gate({}, 1.0);
  EXPECT_TRUE(gate.mayReach(1000000 * kMillisecond, 0.0));
}

TEST(LockstepGate, staysWithinSlackOfTheSlowest) {
  LockstepGate gate({{"a", 0.1}, {"b", 0.1}}, 1.0);
  EXPECT_TRUE(gate.mayReach(100 * kMillisecond, 0.0));
  EXPECT_FALSE(gate.mayReach(101 * kMillisecond, 0.0));
  gate.acknowledge(0, 50 * kMillisecond, 100 * kMillisecond);
  EXPECT_FALSE(gate.mayReach(101 * kMillisecond, 0.0)) << "b has acknowledged nothing";
  gate.acknowledge(1, 20 * kMillisecond, 100 * kMillisecond);
  EXPECT_TRUE(gate.mayReach(120 * kMillisecond, 0.0));
  EXPECT_FALSE(gate.mayReach(121 * kMillisecond, 0.0));
}

TEST(LockstepGate, givesEachItsOwnSlack) {
  LockstepGate gate({{"often", 0.06}, {"seldom", 0.16}}, 1.0);
  gate.acknowledge(0, 100 * kMillisecond, 160 * kMillisecond);
  EXPECT_TRUE(gate.mayReach(160 * kMillisecond, 0.0));
  EXPECT_FALSE(gate.mayReach(161 * kMillisecond, 0.0)) << "held up by the one that hears often";
  gate.acknowledge(0, 160 * kMillisecond, 160 * kMillisecond);
  EXPECT_FALSE(gate.mayReach(161 * kMillisecond, 0.0)) << "held up by the one that hears seldom";
}

TEST(LockstepGate, givesUpWhoHoldsItUpTooLongAndSaysSoOnce) {
  LockstepGate gate({{"a", 0.1}, {"b", 0.1}}, 1.0);
  gate.acknowledge(0, 500 * kMillisecond, 500 * kMillisecond);
  EXPECT_FALSE(gate.mayReach(510 * kMillisecond, 10.0));
  EXPECT_FALSE(gate.mayReach(510 * kMillisecond, 11.0));
  EXPECT_TRUE(gate.mayReach(510 * kMillisecond, 11.1));
  EXPECT_EQ(gate.takeGivenUp(), std::vector<std::string>{"b"});
  EXPECT_TRUE(gate.mayReach(520 * kMillisecond, 20.0));
  EXPECT_TRUE(gate.takeGivenUp().empty());
}

TEST(LockstepGate, takesBackWhoAcknowledgesAgain) {
  LockstepGate gate({{"a", 0.1}}, 1.0);
  EXPECT_FALSE(gate.mayReach(200 * kMillisecond, 0.0));
  EXPECT_TRUE(gate.mayReach(200 * kMillisecond, 2.0));
  gate.acknowledge(0, 200 * kMillisecond, 200 * kMillisecond);
  EXPECT_TRUE(gate.mayReach(300 * kMillisecond, 2.0));
  EXPECT_FALSE(gate.mayReach(301 * kMillisecond, 2.0));
}

TEST(LockstepGate, countsTheTimeoutOnlyWhileItIsHeldUp) {
  LockstepGate gate({{"a", 0.1}}, 1.0);
  EXPECT_FALSE(gate.mayReach(200 * kMillisecond, 0.0));
  gate.acknowledge(0, 100 * kMillisecond, 200 * kMillisecond);
  EXPECT_FALSE(gate.mayReach(300 * kMillisecond, 5.0)) << "held up since 5.0 only";
  EXPECT_TRUE(gate.takeGivenUp().empty());
}

TEST(LockstepGate, takesAStampFromTheFutureForNow) {
  LockstepGate gate({{"a", 0.1}}, 1.0);
  gate.acknowledge(0, 1'000'000'000'000'000'000, 50 * kMillisecond);
  EXPECT_TRUE(gate.mayReach(150 * kMillisecond, 0.0));
  EXPECT_FALSE(gate.mayReach(151 * kMillisecond, 0.0));
}

}  // namespace
}  // namespace kobuki_sim
