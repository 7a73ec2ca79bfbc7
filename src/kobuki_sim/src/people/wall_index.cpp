// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/wall_index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;
using sarn::CellIndex;

constexpr double kSquare = 0.5;  // [m] edge of an index square
constexpr std::size_t kMostEdges = 32;

double distanceToChord(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d chord = b - a;
  const double squared = chord.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(chord) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * chord).norm();
}

/// Douglas-Peucker between points[first] and points[last]: marks what has to stay.
void markCorners(const std::vector<Vector2d>& points, std::size_t first, std::size_t last, double tolerance,
                 std::vector<char>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> pending{{first, last}};
  while (!pending.empty()) {
    const auto [a, b] = pending.back();
    pending.pop_back();
    double worst = tolerance;
    std::size_t corner = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double distance = distanceToChord(points[i], points[a], points[b]);
      if (distance > worst) {
        worst = distance;
        corner = i;
      }
    }
    if (corner == a) continue;
    keep[corner] = 1;
    pending.push_back({a, corner});
    pending.push_back({corner, b});
  }
}

/// A closed outline with few points: anchored at two far corners, which stay.
std::vector<Vector2d> simplified(std::vector<Vector2d> loop, double tolerance) {
  const auto far = std::max_element(loop.begin(), loop.end(), [&](const Vector2d& a, const Vector2d& b) {
    return (a - loop.front()).squaredNorm() < (b - loop.front()).squaredNorm();
  });
  const auto anchor = static_cast<std::size_t>(far - loop.begin());
  loop.push_back(loop.front());
  std::vector<char> keep(loop.size(), 0);
  keep.front() = keep[anchor] = 1;
  markCorners(loop, 0, anchor, tolerance, keep);
  markCorners(loop, anchor, loop.size() - 1, tolerance, keep);
  std::vector<Vector2d> result;
  for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
    if (keep[i] != 0) result.push_back(loop[i]);
  }
  return result;
}

// Directions along cell edges in counter-clockwise order: east, north, west, south.
constexpr int kStepX[] = {1, 0, -1, 0};
constexpr int kStepY[] = {0, 1, 0, -1};

/// Walks along the cracks between occupied and open cells with the wall on the left.
class CrackFollower {
 public:
  explicit CrackFollower(const StaticMap& map)
      : map_(map),
        width_(map.geometry().width + 1),
        visited_(static_cast<std::size_t>(width_) * (static_cast<std::size_t>(map.geometry().height) + 1) * 4,
                 0) {}

  /// Whether a crack leaves the grid corner in the direction: occupied on its left, open on its right.
  [[nodiscard]] bool isCrack(const CellIndex& corner, int direction) const {
    return map_.occupied(leftCell(corner, direction)) &&
           !map_.occupied(leftCell(corner, (direction + 3) % 4));
  }
  [[nodiscard]] bool isNew(const CellIndex& corner, int direction) const {
    return visited_[slot(corner, direction)] == 0;
  }

  /// Corners of the loop that begins here, only where it turns.
  std::vector<Vector2d> follow(CellIndex corner, int direction) {
    std::vector<Vector2d> loop;
    const int first = direction;
    int previous = -1;
    while (isNew(corner, direction)) {
      visited_[slot(corner, direction)] = 1;
      if (direction != previous) loop.push_back(point(corner));
      previous = direction;
      corner = {corner.x + kStepX[direction], corner.y + kStepY[direction]};
      direction = nextDirection(corner, direction);
    }
    if (previous == first) loop.erase(loop.begin());  // it began in the middle of a straight piece
    return loop;
  }

 private:
  /// Cell on the left of the crack that leaves the corner in the direction.
  [[nodiscard]] static CellIndex leftCell(const CellIndex& corner, int direction) {
    const int dx = direction == 1 || direction == 2 ? -1 : 0;
    const int dy = direction == 2 || direction == 3 ? -1 : 0;
    return {corner.x + dx, corner.y + dy};
  }
  /// Cells that touch at a corner belong to one wall: nobody fits between them, so the outline turns right
  /// first.
  [[nodiscard]] int nextDirection(const CellIndex& corner, int direction) const {
    for (const int turn : {3, 0, 1}) {
      const int candidate = (direction + turn) % 4;
      if (isCrack(corner, candidate)) return candidate;
    }
    return direction;
  }
  [[nodiscard]] std::size_t slot(const CellIndex& corner, int direction) const {
    return (static_cast<std::size_t>(corner.y) * static_cast<std::size_t>(width_) +
            static_cast<std::size_t>(corner.x)) *
               4 +
           static_cast<std::size_t>(direction);
  }
  [[nodiscard]] Vector2d point(const CellIndex& corner) const {
    const sarn::GridGeometry& g = map_.geometry();
    return {g.origin_x + corner.x * g.resolution, g.origin_y + corner.y * g.resolution};
  }

  const StaticMap& map_;
  int width_;  // corners along x
  std::vector<char> visited_;
};

double distanceToSquare(const WallEdge& edge, const Vector2d& center, double half) {
  return std::sqrt(edge.squaredDistance(center)) - std::sqrt(2.0) * half;
}

}  // namespace

std::vector<std::vector<Vector2d>> wallOutlines(const StaticMap& map, double tolerance) {
  std::vector<std::vector<Vector2d>> outlines;
  if (map.empty()) return outlines;
  CrackFollower follower(map);
  for (int y = 0; y < map.geometry().height; ++y) {
    for (int x = 0; x < map.geometry().width; ++x) {
      if (!map.occupied(CellIndex{x, y})) continue;
      // The lower crack of a cell runs east; the upper one, seen from above its right corner, west.
      for (const auto& [corner, direction] : {std::pair<CellIndex, int>{{x, y}, 0}, {{x + 1, y + 1}, 2}}) {
        if (!follower.isCrack(corner, direction) || !follower.isNew(corner, direction)) continue;
        outlines.push_back(simplified(follower.follow(corner, direction), tolerance));
      }
    }
  }
  return outlines;
}

WallIndex::WallIndex(std::vector<WallEdge> edges, double reach) : edges_(std::move(edges)) {
  begin_.assign(1, 0);
  if (edges_.empty()) return;
  Vector2d low = edges_.front().start.point;
  Vector2d high = low;
  for (const WallEdge& edge : edges_) {
    low = low.cwiseMin(edge.start.point);
    high = high.cwiseMax(edge.start.point);
  }
  const Vector2d cells = (high - low + Vector2d::Constant(2.0 * reach)) / kSquare;
  squares_ = {static_cast<int>(cells.x()) + 1, static_cast<int>(cells.y()) + 1, kSquare, low.x() - reach,
              low.y() - reach};
  std::vector<std::vector<std::uint32_t>> lists(squares_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Vector2d& a = edges_[i].start.point;
    const Vector2d& b = edges_[i].end.point;
    const Vector2d margin = Vector2d::Constant(reach + kSquare);
    const Vector2d lower = a.cwiseMin(b) - margin;
    const Vector2d upper = a.cwiseMax(b) + margin;
    const CellIndex from = squares_.cellAtUnbounded(lower.x(), lower.y());
    const CellIndex to = squares_.cellAtUnbounded(upper.x(), upper.y());
    for (int y = std::max(0, from.y); y <= std::min(squares_.height - 1, to.y); ++y) {
      for (int x = std::max(0, from.x); x <= std::min(squares_.width - 1, to.x); ++x) {
        const CellIndex square{x, y};
        if (distanceToSquare(edges_[i], squares_.center(square), 0.5 * kSquare) > reach) continue;
        lists[squares_.index(square)].push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  for (const auto& list : lists) {
    in_reach_.insert(in_reach_.end(), list.begin(), list.end());
    begin_.push_back(static_cast<std::uint32_t>(in_reach_.size()));
  }
}

void WallIndex::nearest(const Vector2d& p, double range, std::size_t max_count,
                        std::vector<WallEdge>& found) const {
  found.clear();
  const auto square = squares_.cellAt(p.x(), p.y());
  if (!square) return;
  struct Candidate {
    double squared_distance;
    std::uint32_t index;
  };
  Candidate nearest[kMostEdges];
  const std::size_t limit = std::min(max_count, kMostEdges);
  std::size_t count = 0;
  const std::size_t s = squares_.index(*square);
  for (std::uint32_t k = begin_[s]; k < begin_[s + 1]; ++k) {
    const WallEdge& edge = edges_[in_reach_[k]];
    if (!edge.faces(p)) continue;
    const Candidate candidate{edge.squaredDistance(p), in_reach_[k]};
    if (candidate.squared_distance >= range * range) continue;
    if (count == limit && candidate.squared_distance >= nearest[limit - 1].squared_distance) continue;
    std::size_t i = count < limit ? count++ : limit - 1;
    for (; i > 0 && nearest[i - 1].squared_distance > candidate.squared_distance; --i)
      nearest[i] = nearest[i - 1];
    nearest[i] = candidate;
  }
  for (std::size_t i = 0; i < count; ++i) found.push_back(edges_[nearest[i].index]);
}

}  // namespace kobuki_sim
