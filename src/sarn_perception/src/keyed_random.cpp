// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/keyed_random.h"

#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_perception {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// FNV-1a.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return value;
}

}  // namespace

KeyedRandom::KeyedRandom(std::uint64_t seed, const std::string& name, std::int64_t nanoseconds)
    : state_(mix(mix(mix(seed) ^ hash(name)) ^ static_cast<std::uint64_t>(nanoseconds))) {}

std::uint64_t KeyedRandom::next() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return mix(state_);
}

double KeyedRandom::uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

double KeyedRandom::normal() {
  const double u = 1.0 - uniform();  // (0, 1]
  const double angle = 2.0 * sarn::kPi * uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(angle);
}

}  // namespace sarn_perception
