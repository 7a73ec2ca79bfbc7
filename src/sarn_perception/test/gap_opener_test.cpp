// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/gap_opener.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sarn_perception {
namespace {

/// One character a beam: '.' no return, 'n' near (0.6 m), 'f' far (4 m), '+' beyond, '-' too close, '_' no
/// pixel.
std::vector<BeamReturn> beams(const std::string& row) {
  std::vector<BeamReturn> result;
  for (const char c : row) {
    BeamReturn beam;
    beam.seen = c != '_';
    if (c == 'n') beam.range = 0.6F;
    if (c == 'f') beam.range = 4.0F;
    beam.beyond = c == '+';
    beam.too_close = c == '-';
    result.push_back(beam);
  }
  return result;
}

/// The beams that were opened: 'o'.
std::string opened(GapOpener& gaps, const std::string& row, double stamp) {
  std::vector<float> ranges(row.size(), 0.0F);
  gaps.open(beams(row), stamp, ranges);
  std::string result;
  for (const float range : ranges) result += std::isinf(range) ? 'o' : ' ';
  return result;
}

TEST(GapOpener, opensGapsBetweenFarThings) {
  GapOpener gaps({});
  EXPECT_EQ(opened(gaps, "f..f_.+..", 0.0), " oo  o oo");
}

TEST(GapOpener, opensNothingBesideNearThings) {
  GapOpener gaps({});
  EXPECT_EQ(opened(gaps, "n..f..-.f", 0.0), "         ");
}

TEST(GapOpener, remembersWhatCameNear) {
  GapOpener gaps({});  // holds 3 s
  (void)opened(gaps, "fnf", 10.0);
  EXPECT_EQ(opened(gaps, "f.f", 10.1), "   ");
  EXPECT_EQ(opened(gaps, "f.f", 12.9), "   ");
  EXPECT_EQ(opened(gaps, "f.f", 13.1), " o ");
}

TEST(GapOpener, forgetsOnceSomethingFartherWasSeen) {
  GapOpener gaps({});
  (void)opened(gaps, "fnf", 10.0);
  (void)opened(gaps, "fff", 10.1);
  EXPECT_EQ(opened(gaps, "f.f", 10.2), " o ");
}

TEST(GapOpener, forgetsWhenTheClockJumpsBack) {
  GapOpener gaps({});
  (void)opened(gaps, "fnf", 10.0);
  EXPECT_EQ(opened(gaps, "f.f", 9.0), " o ");
}

}  // namespace
}  // namespace sarn_perception
