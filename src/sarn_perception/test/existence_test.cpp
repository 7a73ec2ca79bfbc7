// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/existence.h"

#include <gtest/gtest.h>

namespace sarn_perception {
namespace {

TEST(Existence, followsBayesRule) {
  // Odds 1:4, seven times as likely: 7:4.
  EXPECT_NEAR(existenceAfterDetection(0.2, 7.0), 7.0 / 11.0, 1e-12);
  // Odds 1:1, a miss has probability 0.1 with a person and 1 without.
  EXPECT_NEAR(existenceAfterMiss(0.5, 0.9), 0.1 / 1.1, 1e-12);
}

TEST(Existence, changesNothingWithoutEvidence) {
  EXPECT_DOUBLE_EQ(existenceAfterDetection(0.3, 1.0), 0.3);
  EXPECT_DOUBLE_EQ(existenceAfterMiss(0.3, 0.0), 0.3);
}

TEST(Existence, missesWeighTheSameASecondAtAnyRate) {
  double slow = 0.9;
  slow = existenceAfterMiss(slow, detectionWithin(0.2, 0.9, 0.2));
  double fast = 0.9;
  for (int i = 0; i < 20; ++i) fast = existenceAfterMiss(fast, detectionWithin(0.01, 0.9, 0.2));
  EXPECT_NEAR(slow, fast, 1e-9);
}

}  // namespace
}  // namespace sarn_perception
