// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/wall_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kStraight = 1e-4;  // [rad] a corner that recedes less counts as straight
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d leftOf(const Vector2d& d) { return {-d.y(), d.x()}; }

WallVertex vertexAt(const std::vector<Vector2d>& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vector2d in = outline[i] - outline[(i + n - 1) % n];
  const Vector2d out = outline[(i + 1) % n] - outline[i];
  if (!(in.squaredNorm() > 0.0 && out.squaredNorm() > 0.0)) {
    throw std::invalid_argument("wall outline: points " + std::to_string(i) + " and its neighbour are equal");
  }
  return {outline[i], in.normalized(), out.normalized(),
          cross(in.normalized(), out.normalized()) >= -kStraight};
}

/// The velocity obstacle of an edge: the shadow of its two end discs, cut off at the time horizon. Seen from
/// the agent, the left leg touches the disc of `left`, the right leg that of `right`.
struct Shadow {
  WallVertex left;
  WallVertex right;
  bool single = false;  // both legs touch the same corner
  Vector2d left_leg;    // unit directions, away from the agent
  Vector2d right_leg;
  bool left_is_neighbors = false;  // the leg would run through the adjoining edge, which speaks for itself
  bool right_is_neighbors = false;
};

/// Tangent from the agent to the disc of `radius` around `offset`, on its left (side 1) or right (side -1).
Vector2d tangent(const Vector2d& offset, double radius, double side) {
  const double squared = offset.squaredNorm();
  const double leg = std::sqrt(std::max(0.0, squared - radius * radius));
  return (leg * offset + side * radius * leftOf(offset)) / squared;
}

/// A leg that points into the adjoining edge of a convex corner is replaced by that edge's line.
void limitLegsByNeighbors(Shadow& s) {
  if (s.left.convex && cross(s.left_leg, -s.left.incoming) >= 0.0) {
    s.left_leg = -s.left.incoming;
    s.left_is_neighbors = true;
  }
  if (s.right.convex && cross(s.right_leg, s.right.outgoing) <= 0.0) {
    s.right_leg = s.right.outgoing;
    s.right_is_neighbors = true;
  }
}

/// Shadow of one corner only, for an agent that sees the edge from its end.
std::optional<Shadow> shadowOfCorner(const WallVertex& corner, const Vector2d& position, double radius) {
  if (!corner.convex) return std::nullopt;
  const Vector2d offset = corner.point - position;
  Shadow s{corner, corner, true, tangent(offset, radius, 1.0), tangent(offset, radius, -1.0), false, false};
  limitLegsByNeighbors(s);
  return s;
}

/// Shadow of the whole edge; at a corner that recedes the edge's own line is the leg.
Shadow shadowOfEdge(const WallEdge& wall, const Vector2d& position, double radius) {
  Shadow s{wall.start, wall.end, false, -wall.direction(), wall.direction(), false, false};
  if (wall.start.convex) s.left_leg = tangent(wall.start.point - position, radius, 1.0);
  if (wall.end.convex) s.right_leg = tangent(wall.end.point - position, radius, -1.0);
  limitLegsByNeighbors(s);
  return s;
}

HalfPlane awayFromDisc(const Vector2d& velocity, const Vector2d& centre, double radius) {
  Vector2d normal = velocity - centre;
  const double norm = normal.norm();
  normal = norm > 0.0 ? Vector2d(normal / norm) : Vector2d(-centre.normalized());
  return {centre + radius * normal, normal};
}

/// Tangent of the shadow at its boundary point nearest to the velocity.
std::optional<HalfPlane> tangentOfShadow(const Shadow& s, const WallEdge& wall, const Vector2d& position,
                                         const Vector2d& velocity, double radius, double time_horizon) {
  const Vector2d left = (s.left.point - position) / time_horizon;
  const Vector2d right = (s.right.point - position) / time_horizon;
  const double cap_radius = radius / time_horizon;
  const Vector2d cap = right - left;

  const double along_cap = s.single ? 0.5 : (velocity - left).dot(cap) / cap.squaredNorm();
  const double along_left = (velocity - left).dot(s.left_leg);
  const double along_right = (velocity - right).dot(s.right_leg);
  if ((along_cap < 0.0 && along_left < 0.0) || (s.single && along_left < 0.0 && along_right < 0.0)) {
    return awayFromDisc(velocity, left, cap_radius);
  }
  if (along_cap > 1.0 && along_right < 0.0) return awayFromDisc(velocity, right, cap_radius);

  const bool beside_cap = s.single || along_cap < 0.0 || along_cap > 1.0;
  const double to_cap = beside_cap ? kInfinity : (velocity - left - along_cap * cap).squaredNorm();
  const double to_left =
      along_left < 0.0 ? kInfinity : (velocity - left - along_left * s.left_leg).squaredNorm();
  const double to_right =
      along_right < 0.0 ? kInfinity : (velocity - right - along_right * s.right_leg).squaredNorm();
  if (to_cap <= to_left && to_cap <= to_right) {
    const Vector2d normal = -leftOf(wall.direction());
    return HalfPlane{left + cap_radius * normal, normal};
  }
  if (to_left <= to_right) {
    if (s.left_is_neighbors) return std::nullopt;
    const Vector2d normal = leftOf(s.left_leg);
    return HalfPlane{left + cap_radius * normal, normal};
  }
  if (s.right_is_neighbors) return std::nullopt;
  const Vector2d normal = -leftOf(s.right_leg);
  return HalfPlane{right + cap_radius * normal, normal};
}

/// The agent touches the corner: it may only move away from it.
std::optional<HalfPlane> awayFromCorner(const WallVertex& corner, const Vector2d& position) {
  const Vector2d away = position - corner.point;
  if (!corner.convex || !(away.squaredNorm() > 0.0)) return std::nullopt;
  return HalfPlane{Vector2d::Zero(), away.normalized()};
}

}  // namespace

bool WallEdge::faces(const Vector2d& p) const { return cross(direction(), p - start.point) < 0.0; }

double WallEdge::squaredDistance(const Vector2d& p) const {
  const Vector2d edge = end.point - start.point;
  const double t = std::clamp((p - start.point).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - start.point - t * edge).squaredNorm();
}

std::vector<WallEdge> wallEdges(const std::vector<std::vector<Vector2d>>& outlines) {
  std::vector<WallEdge> edges;
  for (const auto& outline : outlines) {
    if (outline.size() < 2) throw std::invalid_argument("wall outline: needs two points or more");
    for (std::size_t i = 0; i < outline.size(); ++i) {
      edges.push_back({vertexAt(outline, i), vertexAt(outline, (i + 1) % outline.size())});
    }
  }
  return edges;
}

std::optional<HalfPlane> wallHalfPlane(const Vector2d& position, const Vector2d& velocity, double radius,
                                       const WallEdge& wall, double time_horizon) {
  const Vector2d edge = wall.end.point - wall.start.point;
  const Vector2d from_start = position - wall.start.point;
  const double along = from_start.dot(edge) / edge.squaredNorm();  // 0 at the start, 1 at the end
  const double squared_radius = radius * radius;
  const bool line_in_reach = (from_start - along * edge).squaredNorm() <= squared_radius;

  if (along < 0.0 && from_start.squaredNorm() <= squared_radius) return awayFromCorner(wall.start, position);
  if (along > 1.0 && (position - wall.end.point).squaredNorm() <= squared_radius) {
    const bool next_edge_speaks = cross(wall.end.point - position, wall.end.outgoing) < 0.0;
    return next_edge_speaks ? std::nullopt : awayFromCorner(wall.end, position);
  }
  if (along >= 0.0 && along <= 1.0 && line_in_reach)
    return HalfPlane{Vector2d::Zero(), -leftOf(wall.direction())};

  std::optional<Shadow> shadow;
  if (line_in_reach) {
    shadow = shadowOfCorner(along < 0.0 ? wall.start : wall.end, position, radius);
  } else {
    shadow = shadowOfEdge(wall, position, radius);
  }
  if (!shadow) return std::nullopt;
  return tangentOfShadow(*shadow, wall, position, velocity, radius, time_horizon);
}

}  // namespace kobuki_sim
