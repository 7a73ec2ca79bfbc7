// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace sarn_perception {

/// Random numbers that belong to a key (seed, name, time) rather than to a place in a sequence, so that one
/// person's noise does not depend on who else is measured. SplitMix64 (Steele, Lea and Flood 2014).
class KeyedRandom {
 public:
  KeyedRandom(std::uint64_t seed, const std::string& name, std::int64_t nanoseconds);

  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  /// Standard normal (Box and Muller 1958).
  [[nodiscard]] double normal();

 private:
  [[nodiscard]] std::uint64_t next();
  std::uint64_t state_;
};

}  // namespace sarn_perception
