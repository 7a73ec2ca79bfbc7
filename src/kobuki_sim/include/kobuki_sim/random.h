// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace kobuki_sim {

/// A stream of random numbers that is the same with every standard library: xoshiro256** (Blackman and Vigna
/// 2021, "Scrambled Linear Pseudorandom Number Generators"), its state filled by splitmix64 from the seed and
/// the stream's name. Streams with different names are independent, so that one consumer's draws never shift
/// another's.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::string_view name = {});

  /// 64 uniformly distributed bits.
  [[nodiscard]] std::uint64_t bits();
  /// Uniform in [0, 1), on multiples of 2^-53.
  [[nodiscard]] double uniform();
  /// Uniform in [low, high).
  [[nodiscard]] double uniform(double low, double high);
  /// Standard normal (Marsaglia's polar method, 1964).
  [[nodiscard]] double normal();

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_normal_ = 0.0;
  bool has_spare_normal_ = false;
};

}  // namespace kobuki_sim
