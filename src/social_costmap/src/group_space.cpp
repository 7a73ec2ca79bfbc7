// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/group_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_common/segments.h"

namespace social_costmap {
namespace {

double cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

// Adds a point to a chain that turns left everywhere.
void extendChain(Polygon& hull, std::size_t chain_begin, const Eigen::Vector2d& point) {
  while (hull.size() >= chain_begin + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0)
    hull.pop_back();
  hull.push_back(point);
}

std::size_t rootOf(const std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i];
  return i;
}

// Which members hang together; equal numbers, one component.
std::vector<std::size_t> components(std::size_t count,
                                    const std::vector<std::pair<std::size_t, std::size_t>>& links) {
  std::vector<std::size_t> parent(count);
  for (std::size_t i = 0; i < count; ++i) parent[i] = i;
  for (const auto& [a, b] : links) parent[rootOf(parent, a)] = rootOf(parent, b);
  std::vector<std::size_t> component(count);
  for (std::size_t i = 0; i < count; ++i) component[i] = rootOf(parent, i);
  return component;
}

// People stand around the hull without a gap: they face each other, a queue does not.
bool closesRound(const Polygon& hull, double link_distance) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if ((hull[(i + 1) % hull.size()] - hull[i]).norm() > link_distance) return false;
  }
  return true;
}

Polygon hullOf(std::vector<Eigen::Vector2d> points) {
  Polygon hull;
  convexHull(points, hull);
  return hull;
}

}  // namespace

void convexHull(std::vector<Eigen::Vector2d>& points, Polygon& hull) {
  hull.clear();
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) {
    hull = points;
    return;
  }
  for (const auto& point : points) extendChain(hull, 0, point);
  const std::size_t upper = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) extendChain(hull, upper, *point);
  hull.pop_back();  // the first point again
}

double distanceTo(const Polygon& polygon, const Eigen::Vector2d& point) {
  bool inside = polygon.size() > 2;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    if (cross(a, b, point) < 0.0) inside = false;
    nearest = std::min(nearest, sarn::distanceToSegment(point, a, b));
  }
  return inside ? 0.0 : nearest;
}

std::vector<std::pair<std::size_t, std::size_t>> neighbourLinks(const std::vector<Eigen::Vector2d>& members,
                                                                double max_length) {
  std::vector<std::pair<std::size_t, std::size_t>> links;
  if (members.empty()) return links;
  std::vector<double> distance(members.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> nearest(members.size(), 0);
  std::vector<bool> in_tree(members.size(), false);
  std::size_t added = 0;
  for (std::size_t round = 1; round < members.size(); ++round) {
    in_tree[added] = true;
    std::size_t best = members.size();
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (in_tree[i]) continue;
      const double d = (members[i] - members[added]).norm();
      if (d < distance[i]) {
        distance[i] = d;
        nearest[i] = added;
      }
      if (best == members.size() || distance[i] < distance[best]) best = i;
    }
    if (distance[best] <= max_length) links.emplace_back(nearest[best], best);
    added = best;
  }
  return links;
}

std::vector<Polygon> groupSpace(const std::vector<Eigen::Vector2d>& from,
                                const std::vector<Eigen::Vector2d>& to, double link_distance) {
  std::vector<Polygon> space;
  const auto links = neighbourLinks(from, link_distance);
  const auto component = components(from.size(), links);
  std::vector<bool> closed(from.size(), false);  // by component
  for (std::size_t root = 0; root < from.size(); ++root) {
    std::vector<Eigen::Vector2d> at_start;
    std::vector<Eigen::Vector2d> on_the_way;
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (component[i] != root) continue;
      at_start.push_back(from[i]);
      on_the_way.insert(on_the_way.end(), {from[i], to[i]});
    }
    if (at_start.size() < 3 || !closesRound(hullOf(std::move(at_start)), link_distance)) continue;
    closed[root] = true;
    space.push_back(hullOf(std::move(on_the_way)));
  }
  for (const auto& [a, b] : links) {
    if (!closed[component[a]]) space.push_back(hullOf({from[a], to[a], from[b], to[b]}));
  }
  return space;
}

}  // namespace social_costmap
