// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sarn_localization/wall_lines.h"

namespace sarn_localization {

/// A heading with its standard error.
struct HeadingBelief {
  double theta = 0.0;  // [rad] in map
  double sigma = 0.0;  // [rad]
};

/// A compass made of walls: where most of them meet at right angles, each tells the robot's heading up to a
/// quarter turn, which odometry settles; so the heading does not drift, however far the robot drives
/// (Nguyen, Harati, Martinelli, Siegwart and Tomatis 2006, "Orthogonal SLAM: a step toward lightweight indoor
/// autonomous navigation"; here for the heading alone).
///
/// An extended Kalman filter of two correlated angles, the heading and the direction of the walls. The map's
/// frame is that of the first heading, which is therefore known exactly: what is seen first, before the
/// odometry drifts, settles how the walls lie in it. Walls that stand any other way are left out; where less
/// than 0.7 of the length of all that was seen agrees, there is no such compass.
class RightAngles {
 public:
  explicit RightAngles(double heading) : state_(heading, 0.0) {}

  /// The robot turned by `angle` [rad], standard error `sigma` [rad].
  void turn(double angle, double sigma);
  /// It sees walls, in its frame.
  void see(const std::vector<WallLine>& lines);
  /// Nothing before walls were seen, or where they do not meet at right angles.
  [[nodiscard]] std::optional<HeadingBelief> heading() const;

 private:
  void learnDirection(const WallLine& line);
  /// Whether the line agrees with what was seen before.
  bool take(const WallLine& line);

  Eigen::Vector2d state_;  // [rad] heading; direction of walls in map, modulo a quarter turn
  Eigen::Matrix2d covariance_ = Eigen::Matrix2d::Zero();  // [rad^2]
  bool known_ = false;                                    // the direction of walls
  double agreeing_ = 0.0;                                 // [m] of walls
  double others_ = 0.0;                                   // [m]
};

}  // namespace sarn_localization
