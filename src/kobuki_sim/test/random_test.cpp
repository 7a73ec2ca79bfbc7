// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/random.h"

#include <gtest/gtest.h>

#include <cmath>

using kobuki_sim::RandomStream;

TEST(RandomStream, sameSeedAndNameGiveSameNumbers) {
  RandomStream a(7, "gyro");
  RandomStream b(7, "gyro");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.normal(), b.normal());
}

TEST(RandomStream, otherSeedOrOtherNameGiveOtherNumbers) {
  RandomStream reference(7, "gyro");
  RandomStream other_seed(8, "gyro");
  RandomStream other_name(7, "wheels");
  const std::uint64_t first = reference.bits();
  EXPECT_NE(first, other_seed.bits());
  EXPECT_NE(first, other_name.bits());
}

// First outputs of xoshiro256** from the state splitmix64(0), ..., computed by an independent implementation.
TEST(RandomStream, followsXoshiro256StarStar) {
  RandomStream stream(0);
  EXPECT_EQ(stream.bits(), 0x99ec5f36cb75f2b4ULL);
  EXPECT_EQ(stream.bits(), 0xbf6e1f784956452aULL);
  EXPECT_EQ(stream.bits(), 0x1a5f849d4933e6e0ULL);
}

TEST(RandomStream, uniformHasItsMoments) {
  RandomStream stream(1);
  const int n = 200000;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum_of_squares += u * u;
  }
  const double mean = sum / n;
  EXPECT_NEAR(mean, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / n));
  EXPECT_NEAR(sum_of_squares / n - mean * mean, 1.0 / 12.0, 1e-3);
}

TEST(RandomStream, normalHasItsMoments) {
  RandomStream stream(1);
  const int n = 200000;
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = stream.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 0.02);
  EXPECT_NEAR(fourth / n, 3.0, 0.12);  // kurtosis of the normal distribution
}
