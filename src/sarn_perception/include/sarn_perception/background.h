// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sarn_common/grid.h"
#include "sarn_common/map_io.h"
#include "sarn_common/pose2d.h"
#include "sarn_perception/tracking_params.h"

namespace sarn_perception {

/// A point that a sensor saw, in the sensor's frame.
struct SeenPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  double sigma = 0.0;                                  // [m] of its range
};

/// What the static map explains of what a sensor sees.
///
/// Points nearer to a wall than a tolerance are background. The localisation's error would need a tolerance
/// that swallows people at some metres (1.5 deg are 13 cm at 5 m), so the points are fitted to the map first:
/// the likelihood field of Thrun, Burgard and Fox 2005 (*Probabilistic Robotics*, sec. 6.4), maximised by
/// Gauss-Newton steps from the localisation's pose, which stays the prior. Points far from walls (people)
/// pull less and less (Geman and McClure 1987). Such a fit has local optima, in which one wall passes for
/// another: of those reached from several headings the likeliest is taken.
class Background {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit Background(const BackgroundParams& params);

  void setMap(const sarn::OccupancyMap& map);
  [[nodiscard]] bool hasMap() const { return !map_.cells.empty(); }

  /// Pose of the sensor in map that fits what it sees best, near the localisation's.
  [[nodiscard]] sarn::Pose2D fit(const std::vector<SeenPoint>& points,
                                 const sarn::Pose2D& map_from_sensor) const;

  /// From a point in map to the nearest wall [m], 0 inside; capped at kReach, which it also is outside the
  /// map.
  [[nodiscard]] double wallDistance(const Eigen::Vector2d& point) const;
  /// Whether a wall explains a point in map that was seen at `range` [m] with standard deviation `sigma` [m].
  [[nodiscard]] bool explains(const Eigen::Vector2d& point, double range, double sigma) const;
  /// Whether the map says nothing about the place: outside it, or an unknown cell.
  [[nodiscard]] bool unknown(const Eigen::Vector2d& point) const;

  static constexpr double kReach = 0.75;  // [m] farther walls do not matter

 private:
  struct Slope {
    double distance = 0.0;                               // [m]
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  // [m/m]
  };
  [[nodiscard]] Slope slope(const Eigen::Vector2d& point) const;
  /// The local optimum of the fit that Gauss-Newton reaches from `start`, the kernel at first `widening`
  /// wide.
  [[nodiscard]] sarn::Pose2D refine(const std::vector<SeenPoint>& points, const sarn::Pose2D& prior,
                                    const sarn::Pose2D& start, double widening) const;
  /// What the fit minimises: -ln of the posterior of a pose, up to a constant.
  [[nodiscard]] double misfit(const std::vector<SeenPoint>& points, const sarn::Pose2D& prior,
                              const sarn::Pose2D& pose) const;
  [[nodiscard]] double cellDistance(const sarn::CellIndex& cell) const;

  BackgroundParams params_;
  sarn::OccupancyMap map_;
  sarn::Grid<float> distance_;  // [m] to the edge of the nearest wall
};

}  // namespace sarn_perception
