// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "kobuki_sim_ros/rate_divider.h"
#include "kobuki_sim_ros/real_time_pacer.h"

namespace kobuki_sim {
namespace {

constexpr std::int64_t kStep = 10'000'000;  // [ns]

int countDue(double frequency, int steps) {
  RateDivider divider(frequency);
  int count = 0;
  for (int i = 1; i <= steps; ++i) count += divider.due(i * kStep) ? 1 : 0;
  return count;
}

TEST(RateDivider, keepsFrequenciesThatDoNotDivideTheStep) {
  EXPECT_NEAR(countDue(30.0, 1000), 300, 1);
  EXPECT_NEAR(countDue(20.0, 1000), 200, 1);
  EXPECT_NEAR(countDue(1.0, 1000), 10, 1);
}

TEST(RateDivider, spacesThirtyHertzByThreeOrFourSteps) {
  RateDivider divider(30.0);
  std::vector<int> due;
  for (int i = 1; i <= 300; ++i) {
    if (divider.due(i * kStep)) due.push_back(i);
  }
  for (std::size_t i = 1; i < due.size(); ++i) {
    EXPECT_GE(due[i] - due[i - 1], 3);
    EXPECT_LE(due[i] - due[i - 1], 4);
  }
}

TEST(RateDivider, isDueAtTheExactMultiple) {
  RateDivider divider(50.0);
  EXPECT_TRUE(divider.due(1 * kStep)) << "the first call";
  for (int i = 1; i < 1000; ++i) {
    EXPECT_TRUE(divider.due(2 * i * kStep)) << i;
    EXPECT_FALSE(divider.due((2 * i + 1) * kStep)) << i;
  }
}

TEST(RealTimePacer, waitsForTheWallClockTimesItsRate) {
  RealTimePacer pacer(2.0);
  EXPECT_DOUBLE_EQ(pacer.delay(0, 100.0), 0.0);
  EXPECT_NEAR(pacer.delay(1'000'000'000, 100.0), 0.5, 1e-9);
  EXPECT_NEAR(pacer.delay(1'000'000'000, 100.4), 0.1, 1e-9);
  EXPECT_DOUBLE_EQ(pacer.delay(1'000'000'000, 100.5), 0.0);
}

TEST(RealTimePacer, catchesUpAShortLag) {
  RealTimePacer pacer(1.0);
  EXPECT_DOUBLE_EQ(pacer.delay(0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.delay(1 * kStep, 0.1), 0.0);
  EXPECT_NEAR(pacer.delay(11 * kStep, 0.1), 0.01, 1e-9) << "still on the first schedule";
}

TEST(RealTimePacer, forgetsALongLag) {
  RealTimePacer pacer(1.0);
  EXPECT_DOUBLE_EQ(pacer.delay(0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(pacer.delay(1 * kStep, 10.0), 0.0);
  EXPECT_NEAR(pacer.delay(2 * kStep, 10.0), 0.01, 1e-9) << "a new schedule began at 10 s";
}

TEST(RealTimePacer, beginsAnewAfterAPause) {
  RealTimePacer pacer(1.0);
  EXPECT_DOUBLE_EQ(pacer.delay(0, 0.0), 0.0);
  pacer.stop();
  EXPECT_DOUBLE_EQ(pacer.delay(50 * kStep, 0.1), 0.0);
}

}  // namespace
}  // namespace kobuki_sim
