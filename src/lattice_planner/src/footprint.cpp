// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/footprint.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sarn_common/segments.h"

namespace lattice_planner {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kThinnest = 1e-3;  // [m] half width that a core keeps where it would be a line

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Crossings of the ray from the origin along +x (Shimrat 1962).
bool holdsOrigin(const Points& corners) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[j];
    if ((a.y() > 0.0) == (b.y() > 0.0)) continue;
    if (a.x() - a.y() * (b.x() - a.x()) / (b.y() - a.y()) > 0.0) inside = !inside;
  }
  return inside;
}

/// Counter-clockwise (Andrew 1979).
Points convexHull(Points points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  Points hull;
  const auto extend = [&hull](const Eigen::Vector2d& p, std::size_t least) {
    while (hull.size() > least && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const auto& p : points) extend(p, 1);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  return hull;
}

/// What of a convex polygon lies on the side of the line where normal . p <= limit (Sutherland and Hodgman
/// 1974).
Points clip(const Points& polygon, const Eigen::Vector2d& normal, double limit) {
  Points kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double beyond_a = normal.dot(a) - limit;
    const double beyond_b = normal.dot(b) - limit;
    if (beyond_a <= 0.0) kept.push_back(a);
    if ((beyond_a < 0.0) != (beyond_b < 0.0) && beyond_a != beyond_b) {
      kept.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
  }
  return kept;
}

}  // namespace

Footprint makeFootprint(Points corners) {
  Footprint footprint;
  if (corners.empty()) return footprint;
  if (corners.size() < 3) throw std::invalid_argument("a polygon has at least three corners");
  footprint.inscribed_radius = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!corners[i].allFinite())
      throw std::invalid_argument("corner " + std::to_string(i) + " is not finite");
    footprint.circumscribed_radius = std::max(footprint.circumscribed_radius, corners[i].norm());
    footprint.inscribed_radius = std::min(
        footprint.inscribed_radius,
        sarn::distanceToSegment(Eigen::Vector2d::Zero(), corners[i], corners[(i + 1) % corners.size()]));
  }
  if (footprint.circumscribed_radius > 10.0) throw std::invalid_argument("a corner is more than 10 m away");
  if (!holdsOrigin(corners) || footprint.inscribed_radius < 0.01)
    throw std::invalid_argument("the robot's origin is not inside, or within 0.01 m of an edge");
  footprint.corners = std::move(corners);
  return footprint;
}

Footprint parseFootprint(const std::string& text) {
  if (text.empty()) return {};
  Points corners;
  try {
    const YAML::Node list = YAML::Load(text);
    if (!list.IsSequence()) throw std::invalid_argument("must be a list of [x, y]");
    for (const auto& corner : list) {
      if (!corner.IsSequence() || corner.size() != 2) throw std::invalid_argument("must be a list of [x, y]");
      corners.emplace_back(corner[0].as<double>(), corner[1].as<double>());
    }
  } catch (const YAML::Exception&) {
    throw std::invalid_argument("must be a list of [x, y]");
  }
  return makeFootprint(std::move(corners));
}

std::string toString(const Footprint& footprint) {
  if (footprint.round()) return {};
  std::ostringstream text;
  text.precision(17);
  for (const auto& corner : footprint.corners) {
    text << (text.tellp() > 0 ? ", [" : "[[") << corner.x() << ", " << corner.y() << "]";
  }
  text << "]";
  return text.str();
}

Points coreOf(const Footprint& footprint) {
  const Points hull = convexHull(footprint.corners);
  Points core = hull;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    const Eigen::Vector2d outward(edge.y(), -edge.x());
    core = clip(core, outward, std::max(kThinnest, outward.dot(hull[i]) - footprint.inscribed_radius));
  }
  return core;
}

}  // namespace lattice_planner
