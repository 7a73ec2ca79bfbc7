// SPDX-License-Identifier: BSD-3-Clause
// The fuzz target on random bytes, the same every time; meant for a build with sanitizers, and a smoke test
// without.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
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

// Inputs that once found a fault: a robot that could steer clear of the map's edge was made to brake over it.
TEST(Fuzz, whatOnceFoundAFaultDoesNotAnyMore) {
  int played = 0;
  for (const auto& file : std::filesystem::directory_iterator("fuzz/corpus")) {
    std::ifstream in(file.path(), std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0) << file.path();
    ++played;
  }
  EXPECT_GT(played, 0);
}

}  // namespace
