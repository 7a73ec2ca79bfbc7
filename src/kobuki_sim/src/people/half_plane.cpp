// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/half_plane.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kParallel = 1e-9;

/// What a programme looks for: the point nearest to `target`, or the farthest one along the unit vector
/// `target`.
struct Objective {
  Vector2d target;
  bool is_direction;
};

/// Along the boundary of a half-plane, the permitted side is on the left.
Vector2d boundaryDirection(const HalfPlane& plane) { return {plane.normal.y(), -plane.normal.x()}; }

Vector2d clampedToDisc(const Vector2d& v, double radius) {
  const double norm_squared = v.squaredNorm();
  return norm_squared > radius * radius ? Vector2d(v * (radius / std::sqrt(norm_squared))) : v;
}

/// Part of the boundary line of planes[i] inside the disc and planes [0, i), as an interval of its parameter.
struct Interval {
  double low;
  double high;
};

std::optional<Interval> permittedInterval(const std::vector<HalfPlane>& planes, std::size_t i,
                                          double radius) {
  const Vector2d& point = planes[i].point;
  const Vector2d direction = boundaryDirection(planes[i]);
  const double middle = -point.dot(direction);
  const double discriminant = middle * middle + radius * radius - point.squaredNorm();
  if (discriminant < 0.0) return std::nullopt;
  const double half = std::sqrt(discriminant);
  Interval interval{middle - half, middle + half};
  for (std::size_t j = 0; j < i; ++j) {
    const double slope = direction.dot(planes[j].normal);
    const double deficit = planes[j].violation(point);
    if (std::abs(slope) <= kParallel) {
      if (deficit > kParallel) return std::nullopt;
      continue;
    }
    const double t = deficit / slope;
    if (slope > 0.0) {
      interval.low = std::max(interval.low, t);
    } else {
      interval.high = std::min(interval.high, t);
    }
    if (interval.low > interval.high) return std::nullopt;
  }
  return interval;
}

/// Best velocity on the boundary of planes[i].
std::optional<Vector2d> bestOnBoundary(const std::vector<HalfPlane>& planes, std::size_t i, double radius,
                                       const Objective& objective) {
  const auto interval = permittedInterval(planes, i, radius);
  if (!interval) return std::nullopt;
  const Vector2d& point = planes[i].point;
  const Vector2d direction = boundaryDirection(planes[i]);
  double t = 0.0;
  if (objective.is_direction) {
    t = objective.target.dot(direction) > 0.0 ? interval->high : interval->low;
  } else {
    t = std::clamp(direction.dot(objective.target - point), interval->low, interval->high);
  }
  return point + t * direction;
}

/// Adds the planes one by one; returns how many could be satisfied together, with the best velocity under
/// those.
std::size_t solveIncrementally(const std::vector<HalfPlane>& planes, double radius,
                               const Objective& objective, Vector2d& result) {
  result =
      objective.is_direction ? Vector2d(objective.target * radius) : clampedToDisc(objective.target, radius);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (planes[i].violation(result) <= 0.0) continue;
    const auto best = bestOnBoundary(planes, i, radius, objective);
    if (!best) return i;
    result = *best;
  }
  return planes.size();
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Vector2d HalfPlaneProgram::nearestVelocity(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                           const Vector2d& preferred, double max_speed) {
  Vector2d result;
  const std::size_t satisfied = solveIncrementally(planes, max_speed, {preferred, false}, result);
  if (satisfied < planes.size()) leastViolation(planes, hard_count, satisfied, max_speed, result);
  return result;
}

/// The 3-D programme of section 5.3: lower the planes by the same distance until one velocity remains. A
/// plane that is worse than the worst so far becomes the worst; the answer then lies where it is equally far
/// inside all others.
void HalfPlaneProgram::leastViolation(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                      std::size_t first_failed, double max_speed, Vector2d& result) {
  double worst = 0.0;
  for (std::size_t i = first_failed; i < planes.size(); ++i) {
    if (planes[i].violation(result) <= worst) continue;
    projectOntoBisectors(planes, hard_count, i);
    Vector2d candidate;
    const Objective deepest{planes[i].normal, true};
    if (solveIncrementally(projected_, max_speed, deepest, candidate) == projected_.size())
      result = candidate;
    worst = planes[i].violation(result);
  }
}

/// Velocities that violate plane j no more than plane i form a half-plane bounded by the bisector of the two.
void HalfPlaneProgram::projectOntoBisectors(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                            std::size_t i) {
  projected_.assign(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(std::min(hard_count, i)));
  for (std::size_t j = hard_count; j < i; ++j) {
    const Vector2d& normal_i = planes[i].normal;
    const Vector2d& normal_j = planes[j].normal;
    HalfPlane bisector;
    const double determinant = cross(normal_i, normal_j);
    if (std::abs(determinant) <= kParallel) {
      if (normal_i.dot(normal_j) > 0.0) continue;
      bisector.point = 0.5 * (planes[i].point + planes[j].point);
    } else {
      const double t = planes[j].violation(planes[i].point) / boundaryDirection(planes[i]).dot(normal_j);
      bisector.point = planes[i].point + t * boundaryDirection(planes[i]);
    }
    bisector.normal = (normal_j - normal_i).normalized();
    projected_.push_back(bisector);
  }
}

}  // namespace kobuki_sim
