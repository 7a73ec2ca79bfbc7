// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kobuki_sim {

/// The permitted velocities v: (v - point) . normal >= 0.
struct HalfPlane {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();    // [m/s]
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // unit length, points into the permitted side

  /// How far v lies on the wrong side [m/s]; negative on the permitted side.
  [[nodiscard]] double violation(const Eigen::Vector2d& v) const { return (point - v).dot(normal); }
};

/// Velocities under half-planes and a speed limit: the linear programmes of van den Berg, Guy, Lin and
/// Manocha, "Reciprocal n-Body Collision Avoidance" (2011), sections 5.2 and 5.3, solved incrementally (de
/// Berg et al., "Computational Geometry", chapter 4). Keeps its working memory, so a solver belongs to one
/// thread.
class HalfPlaneProgram {
 public:
  /// Velocity nearest to `preferred` with speed at most `max_speed` that satisfies every plane. When there is
  /// none, the velocity that minimises the worst violation of the planes from `hard_count` on, while the
  /// first `hard_count` (walls) stay satisfied.
  [[nodiscard]] Eigen::Vector2d nearestVelocity(const std::vector<HalfPlane>& planes, std::size_t hard_count,
                                                const Eigen::Vector2d& preferred, double max_speed);

 private:
  void leastViolation(const std::vector<HalfPlane>& planes, std::size_t hard_count, std::size_t first_failed,
                      double max_speed, Eigen::Vector2d& result);
  void projectOntoBisectors(const std::vector<HalfPlane>& planes, std::size_t hard_count, std::size_t i);

  std::vector<HalfPlane> projected_;
};

}  // namespace kobuki_sim
