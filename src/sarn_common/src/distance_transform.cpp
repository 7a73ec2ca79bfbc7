// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/distance_transform.h"

#include <cmath>
#include <limits>
#include <vector>

namespace sarn {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Squared distances along one line of n samples: out[q] = min_p (q - p)^2 + f[p].
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t longest) : vertex_(longest), bound_(longest + 1) {}

  void transform(const std::vector<float>& f, std::size_t n, std::vector<float>& out) {
    const std::size_t count = build(f, n);
    if (count == 0) {
      for (std::size_t q = 0; q < n; ++q) out[q] = kInfinity;
      return;
    }
    std::size_t k = 0;
    for (std::size_t q = 0; q < n; ++q) {
      while (k + 1 < count && bound_[k + 1] < static_cast<double>(q)) ++k;
      const double d = static_cast<double>(q) - static_cast<double>(vertex_[k]);
      out[q] = static_cast<float>(d * d + static_cast<double>(f[vertex_[k]]));
    }
  }

 private:
  /// Parabolas of the envelope, left to right; bound_[k] is where parabola k becomes the lowest.
  std::size_t build(const std::vector<float>& f, std::size_t n) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < n; ++q) {
      if (f[q] == kInfinity) continue;
      double start = -HUGE_VAL;
      while (count > 0) {
        start = intersection(f, vertex_[count - 1], q);
        if (start > bound_[count - 1]) break;
        --count;
        start = -HUGE_VAL;
      }
      vertex_[count] = q;
      bound_[count] = start;
      ++count;
    }
    return count;
  }

  [[nodiscard]] static double intersection(const std::vector<float>& f, std::size_t p, std::size_t q) {
    const double a = static_cast<double>(p);
    const double b = static_cast<double>(q);
    return ((static_cast<double>(f[q]) + b * b) - (static_cast<double>(f[p]) + a * a)) / (2.0 * (b - a));
  }

  std::vector<std::size_t> vertex_;
  std::vector<double> bound_;
};

}  // namespace

Grid<float> distanceTransform(const Grid<std::uint8_t>& occupied) {
  const auto width = static_cast<std::size_t>(occupied.geometry.width);
  const auto height = static_cast<std::size_t>(occupied.geometry.height);
  Grid<float> distance(occupied.geometry, kInfinity);
  for (std::size_t i = 0; i < occupied.cells.size(); ++i) {
    if (occupied.cells[i] != 0) distance.cells[i] = 0.0F;
  }
  const std::size_t longest = std::max(width, height);
  LowerEnvelope envelope(longest);
  std::vector<float> line(longest);
  std::vector<float> result(longest);
  for (std::size_t x = 0; x < width; ++x) {
    for (std::size_t y = 0; y < height; ++y) line[y] = distance.cells[y * width + x];
    envelope.transform(line, height, result);
    for (std::size_t y = 0; y < height; ++y) distance.cells[y * width + x] = result[y];
  }
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) line[x] = distance.cells[y * width + x];
    envelope.transform(line, width, result);
    for (std::size_t x = 0; x < width; ++x) {
      distance.cells[y * width + x] = std::sqrt(result[x]) * static_cast<float>(occupied.geometry.resolution);
    }
  }
  return distance;
}

}  // namespace sarn
