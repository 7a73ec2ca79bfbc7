// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sarn_localization {

/// A straight stretch of wall in a scan.
struct WallLine {
  double direction = 0.0;  // [rad] in the scan's frame, the same as that + pi
  double sigma = 0.0;      // [rad] standard error of it
  double length = 0.0;     // [m]
};

/// How straight a wall looks, and what is long enough to be one.
struct WallLineParams {
  double sigma = 0.006;         // [m] of a return about its wall, whatever the range
  double sigma_range = 0.0015;  // [1/m] and along its beam by this times r^2, at a range r
  double gap = 0.3;             // [m] a wall's neighbouring returns are nearer to each other
  double min_length = 0.8;      // [m] shorter ones are people and furniture
  int min_returns = 12;
};

/// Straight walls in the ends [m] of a scan's beams, in their order about the sensor: split at the point
/// farthest from the chord until all lie on their lines (Ramer 1972; Nguyen, Gaechter, Martinelli, Tomatis
/// and Siegwart 2007, "A comparison of line extraction algorithms using 2D range data for indoor mobile
/// robotics", sec. 3.1), each fitted by weighted total least squares. A range's error counts by its part
/// across the wall, so that a wall seen at a grazing angle tells its direction best.
[[nodiscard]] std::vector<WallLine> wallLines(const std::vector<Eigen::Vector2d>& ends,
                                              const Eigen::Vector2d& sensor, const WallLineParams& params);

}  // namespace sarn_localization
