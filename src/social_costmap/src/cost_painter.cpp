// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/cost_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sarn_common/cost_values.h"

// The loops over a row are written so that the compiler vectorises them: no branches, no calls, single
// precision relative to the start of the row (whose place is computed in double precision).
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Chosen at load time. AVX2 without FMA rounds like the default, so that every machine paints the same costs.
#define SOCIAL_COSTMAP_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define SOCIAL_COSTMAP_VECTORISED
#endif

namespace social_costmap {
namespace {

/// e^-q for q >= 0 as (Taylor of degree 4 at -q / 8)^8. Times 252 it is within 0.011 of the exact value for q
/// <= 5.6 and below 1 beyond (q counts as 8 at most: the polynomial grows again).
inline float expOfNegative(float q) {
  const float t = -0.125F * (q < 8.0F ? q : 8.0F);
  float p = 1.0F + t * (1.0F + t * (0.5F + t * (1.0F / 6.0F + t * (1.0F / 24.0F))));
  p *= p;
  p *= p;
  return p * p;
}

/// Cells whose area meets the box [m], clipped to the grid; safe for any finite numbers.
CellRect cellsOfBox(const sarn::GridGeometry& grid, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const auto column = [&](double x) {
    return static_cast<int>(
        std::clamp(std::floor((x - grid.origin_x) / grid.resolution), -1.0, grid.width + 0.0));
  };
  const auto row = [&](double y) {
    return static_cast<int>(
        std::clamp(std::floor((y - grid.origin_y) / grid.resolution), -1.0, grid.height + 0.0));
  };
  return CellRect{column(low.x()), row(low.y()), column(high.x()) + 1, row(high.y()) + 1}.clipped(grid);
}

/// A turned rectangle: 'along' runs in the direction of its heading from its origin, 'across' to the left of
/// it.
struct TurnedBox {
  Eigen::Vector2d origin;       // [m]
  Eigen::Vector2d direction;    // unit vector
  double along_min, along_max;  // [m]
  double across_max;            // [m] on both sides

  [[nodiscard]] CellRect cells(const sarn::GridGeometry& grid) const {
    const Eigen::Vector2d left(-direction.y(), direction.x());
    const Eigen::Vector2d near = origin + along_min * direction;
    const Eigen::Vector2d far = origin + along_max * direction;
    const Eigen::Vector2d margin = across_max * left.cwiseAbs();
    return cellsOfBox(grid, near.cwiseMin(far) - margin, near.cwiseMax(far) + margin);
  }
};

/// The part of one row of cells inside a turned box, with the coordinates of its first cell and from cell to
/// cell.
struct RowSpan {
  int begin, end;                 // [cells] columns
  float along, across;            // [m] of the first cell's centre
  float along_step, across_step;  // [m]
};

/// Cells are painted in blocks of this many where the row is long enough: the vector loop then has no
/// remainder.
constexpr int kBlock = 16;

/// Where a coordinate that grows by the same step from cell to cell stays within [low, high].
class LinearClip {
 public:
  LinearClip(double step, double low, double high) : low_(low), high_(high) {
    constant_ = std::abs(step) < 1e-12;
    inverse_ = constant_ ? 0.0 : 1.0 / step;
  }
  /// Narrows [begin, end] [cells], given the value at cell 0.
  void narrow(double value, double& begin, double& end) const {
    if (constant_) {
      if (value < low_ || value > high_) end = begin - 1.0;
      return;
    }
    const double a = (low_ - value) * inverse_;
    const double b = (high_ - value) * inverse_;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }

 private:
  double low_, high_, inverse_;
  bool constant_;
};

/// Widens [begin, end) within [0, width) to whole blocks, where that is possible.
void widenToBlocks(int width, int& begin, int& end) {
  const int wanted = (end - begin + kBlock - 1) / kBlock * kBlock;
  end = std::min(width, begin + wanted);
  begin = std::max(0, end - wanted);
}

/// Calls visit(RowSpan, first cell) for each row that crosses the box. Spans may reach beyond the box.
template <class Visit>
CellRect forEachRow(const TurnedBox& box, const sarn::GridGeometry& grid, std::uint8_t* cells,
                    Visit&& visit) {
  const CellRect rect = box.cells(grid);
  const double cos = box.direction.x();
  const double sin = box.direction.y();
  const double along_step = cos * grid.resolution;
  const double across_step = -sin * grid.resolution;
  const LinearClip along_clip(along_step, box.along_min, box.along_max);
  const LinearClip across_clip(across_step, -box.across_max, box.across_max);
  const double dx = grid.origin_x + 0.5 * grid.resolution - box.origin.x();
  for (int y = rect.min_y; y < rect.max_y; ++y) {
    const double dy = grid.origin_y + (y + 0.5) * grid.resolution - box.origin.y();
    const double along = cos * dx + sin * dy;
    const double across = cos * dy - sin * dx;
    double begin = rect.min_x;
    double end = rect.max_x - 1;
    along_clip.narrow(along, begin, end);
    across_clip.narrow(across, begin, end);
    if (begin > end) continue;
    int first = static_cast<int>(begin);
    int past = static_cast<int>(end) + 1;
    widenToBlocks(grid.width, first, past);
    visit(RowSpan{first, past, static_cast<float>(along + first * along_step),
                  static_cast<float>(across + first * across_step), static_cast<float>(along_step),
                  static_cast<float>(across_step)},
          cells + grid.index({first, y}));
  }
  return rect;
}

inline std::uint8_t atLeast(std::uint8_t old, int cost) {
  return std::max(old, static_cast<std::uint8_t>(cost));
}

/// Distance [m] at which a Gaussian falls to the cutoff, or a little farther: single precision may still
/// paint there.
double reach(double sigma, double amplitude, double cutoff) {
  constexpr double kPainterError = 0.02;
  return sigma * std::sqrt(2.0 * std::log(amplitude / (cutoff - kPainterError)));
}

/// A SweptGaussian in the numbers that the inner loop needs.
struct GaussianRowKernel {
  float length;             // [m]
  float front, rear, side;  // [1/m] 1 / (sigma sqrt(2))
  float amplitude, cutoff;
};

GaussianRowKernel kernelOf(const SweptGaussian& g, double cutoff) {
  const auto scale = [](double sigma) { return static_cast<float>(1.0 / (sigma * std::sqrt(2.0))); };
  return {
      static_cast<float>(g.length),    scale(g.sigma_front),      scale(g.sigma_rear), scale(g.sigma_side),
      static_cast<float>(g.amplitude), static_cast<float>(cutoff)};
}

SOCIAL_COSTMAP_VECTORISED void paintGaussianRow(const RowSpan& row, const GaussianRowKernel& g,
                                                std::uint8_t* __restrict cell) {
  const int count = row.end - row.begin;
  for (int i = 0; i < count; ++i) {
    const float along = row.along + static_cast<float>(i) * row.along_step;
    const float w = (row.across + static_cast<float>(i) * row.across_step) * g.side;
    const float ahead = along - g.length;
    const float u = (ahead > 0.0F ? ahead : 0.0F) * g.front + (along < 0.0F ? along : 0.0F) * g.rear;
    const float value = g.amplitude * expOfNegative(u * u + w * w);
    const int cost = static_cast<int>(value >= g.cutoff ? value : 0.0F);
    cell[i] = atLeast(cell[i], cost);
  }
}

SOCIAL_COSTMAP_VECTORISED void paintDiscRow(const RowSpan& row, float length, float radius,
                                            std::uint8_t* __restrict cell) {
  const float radius2 = radius * radius;
  const int count = row.end - row.begin;
  for (int i = 0; i < count; ++i) {
    const float along = row.along + static_cast<float>(i) * row.along_step;
    const float across = row.across + static_cast<float>(i) * row.across_step;
    const float ahead = along - length;
    const float u = (ahead > 0.0F ? ahead : 0.0F) + (along < 0.0F ? along : 0.0F);
    const int cost = u * u + across * across <= radius2 ? sarn::kLethalObstacle : 0;
    cell[i] = atLeast(cell[i], cost);
  }
}

constexpr int kChunk = 64;  // cells whose distances are held at a time
using Distances = std::array<float, kChunk>;

/// Lowers `squared` to the squared distance from a segment, and `inside` to the side of it (negative: right
/// of it).
SOCIAL_COSTMAP_VECTORISED void measureEdge(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                           const Eigen::Vector2d& first, double resolution, int count,
                                           Distances& squared, Distances& inside) {
  const Eigen::Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  const auto dx = static_cast<float>(d.x());
  const auto dy = static_cast<float>(d.y());
  const auto px0 = static_cast<float>(first.x() - a.x());
  const auto py = static_cast<float>(first.y() - a.y());
  const auto step = static_cast<float>(resolution);
  const auto scale = static_cast<float>(length2 > 0.0 ? 1.0 / length2 : 0.0);
  for (int i = 0; i < count; ++i) {
    const float px = px0 + static_cast<float>(i) * step;
    const float ratio = (px * dx + py * dy) * scale;
    const float above = ratio > 0.0F ? ratio : 0.0F;
    const float s = above < 1.0F ? above : 1.0F;
    const float ex = px - s * dx;
    const float ey = py - s * dy;
    const float distance2 = ex * ex + ey * ey;
    const float left = dx * py - dy * px;
    const auto k = static_cast<std::size_t>(i);
    squared[k] = distance2 < squared[k] ? distance2 : squared[k];
    inside[k] = left < inside[k] ? left : inside[k];
  }
}

struct FadingCost {
  float amplitude;
  float half_precision;  // [1/m^2] 1 / (2 sigma^2)
  float cutoff;
};

void paintPolygonChunk(const Polygon& polygon, const Eigen::Vector2d& first, double resolution, int count,
                       const FadingCost& cost, std::uint8_t* __restrict cell) {
  Distances squared;
  Distances inside;
  squared.fill(std::numeric_limits<float>::max());
  inside.fill(polygon.size() > 2 ? 1.0F : -1.0F);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    measureEdge(polygon[i], polygon[(i + 1) % polygon.size()], first, resolution, count, squared, inside);
  }
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const float distance2 = inside[k] >= 0.0F ? 0.0F : squared[k];
    const float q = distance2 * cost.half_precision;
    const float value = cost.amplitude * expOfNegative(q);
    cell[i] = atLeast(cell[i], static_cast<int>(value >= cost.cutoff ? value : 0.0F));
  }
}

}  // namespace

CellRect paint(const SweptGaussian& g, double cutoff, const sarn::GridGeometry& grid, std::uint8_t* cells) {
  if (!(g.amplitude >= cutoff)) return {};
  const TurnedBox box{g.start,
                      {std::cos(g.heading), std::sin(g.heading)},
                      -reach(g.sigma_rear, g.amplitude, cutoff),
                      g.length + reach(g.sigma_front, g.amplitude, cutoff),
                      reach(g.sigma_side, g.amplitude, cutoff)};
  const GaussianRowKernel kernel = kernelOf(g, cutoff);
  return forEachRow(box, grid, cells,
                    [&](const RowSpan& row, std::uint8_t* cell) { paintGaussianRow(row, kernel, cell); });
}

CellRect paint(const SweptDisc& disc, const sarn::GridGeometry& grid, std::uint8_t* cells) {
  if (!(disc.radius > 0.0)) return {};
  const Eigen::Vector2d d = disc.b - disc.a;
  const double length = d.norm();
  const Eigen::Vector2d direction = length > 0.0 ? Eigen::Vector2d(d / length) : Eigen::Vector2d::UnitX();
  const TurnedBox box{disc.a, direction, -disc.radius, length + disc.radius, disc.radius};
  const CellRect rect = forEachRow(box, grid, cells, [&](const RowSpan& row, std::uint8_t* cell) {
    paintDiscRow(row, static_cast<float>(length), static_cast<float>(disc.radius), cell);
  });
  for (const Eigen::Vector2d& end : {disc.a, disc.b}) {
    if (const auto cell = grid.cellAt(end.x(), end.y())) cells[grid.index(*cell)] = sarn::kLethalObstacle;
  }
  return rect;
}

CellRect paint(const Polygon& polygon, double amplitude, double sigma, double cutoff,
               const sarn::GridGeometry& grid, std::uint8_t* cells) {
  if (!(amplitude >= cutoff) || polygon.empty()) return {};
  Eigen::Vector2d low = polygon.front();
  Eigen::Vector2d high = polygon.front();
  for (const Eigen::Vector2d& corner : polygon) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach(sigma, amplitude, cutoff));
  const CellRect rect = cellsOfBox(grid, low - margin, high + margin);
  const FadingCost cost{static_cast<float>(amplitude), static_cast<float>(0.5 / (sigma * sigma)),
                        static_cast<float>(cutoff)};
  for (int y = rect.min_y; y < rect.max_y; ++y) {
    for (int x = rect.min_x; x < rect.max_x; x += kChunk) {
      paintPolygonChunk(polygon, grid.center({x, y}), grid.resolution, std::min(kChunk, rect.max_x - x), cost,
                        cells + grid.index({x, y}));
    }
  }
  return rect;
}

}  // namespace social_costmap
