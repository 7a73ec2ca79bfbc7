// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/swept_corridor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_common/angles.h"

namespace sarn_navigation {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kStraight = 1e-4;  // [1/m] smaller curvature counts as a straight line
constexpr double kInsideShrink =
    0.95;  // a point inside the disc: the disc shrinks to this share of its distance

/// The robot drives along +x.
double freeStraight(const Eigen::Vector2d& p, double radius) {
  if (p.x() <= 0.0 || std::abs(p.y()) >= radius) return kNever;
  return std::max(0.0, p.x() - std::sqrt(radius * radius - p.y() * p.y()));
}

/// The robot starts along +x on a circle to the left around (0, rho), rho > 0. With d the point's distance
/// from that centre, the disc touches it where radius^2 = rho^2 + d^2 - 2 rho d cos(delta): the law of
/// cosines.
double freeOnLeftArc(const Eigen::Vector2d& p, double rho, double radius) {
  const Eigen::Vector2d from_centre = p - Eigen::Vector2d(0.0, rho);
  const double d = from_centre.norm();
  if (d < 1e-9) return kNever;
  const double cos_delta = (rho * rho + d * d - radius * radius) / (2.0 * rho * d);
  if (cos_delta >= 1.0) return kNever;
  const double delta = std::acos(std::max(-1.0, cos_delta));
  const double bearing = std::atan2(from_centre.x(), -from_centre.y());  // along the travel, from the start
  double angle = bearing - delta;
  while (angle < 0.0) angle += 2.0 * sarn::kPi;
  return rho * angle;
}

}  // namespace

double stoppingDistance(double v, double reaction_time, double deceleration) {
  return std::abs(v) * reaction_time + v * v / (2.0 * deceleration);
}

double speedThatStopsWithin(double distance, double reaction_time, double deceleration) {
  const double lost = deceleration * reaction_time;
  return std::sqrt(lost * lost + 2.0 * deceleration * std::max(0.0, distance)) - lost;
}

double freeDistance(const sarn::Twist2D& twist, const Eigen::Vector2d& point, double radius) {
  if (twist.v == 0.0) return kNever;
  Eigen::Vector2d p = point;
  double omega = twist.omega;
  if (twist.v < 0.0) {  // mirror the x axis: backwards becomes forwards, and a turn changes its sign
    p.x() = -p.x();
    omega = -omega;
  }
  const double shrunk = std::min(radius, kInsideShrink * p.norm());
  const double curvature = omega / std::abs(twist.v);
  if (std::abs(curvature) < kStraight) return freeStraight(p, shrunk);
  if (curvature < 0.0) p.y() = -p.y();  // mirror the y axis: right becomes left
  return freeOnLeftArc(p, 1.0 / std::abs(curvature), shrunk);
}

}  // namespace sarn_navigation
