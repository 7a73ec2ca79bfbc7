// SPDX-License-Identifier: BSD-3-Clause
// The fuzz target on random bytes, the same every time; meant for a build with sanitizers, and a smoke test
// without.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

TEST(Fuzz, anyBytesGetOneOutcome) {
  std::mt19937 random(1);
  for (int input = 0; input < 3000; ++input) {
    std::vector<std::uint8_t> bytes(random() % 400);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

}  // namespace
