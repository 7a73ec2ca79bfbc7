// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/walking_space.h"

#include <algorithm>
#include <cmath>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr int kMaxPushes = 4;      // corners that a body can be caught in at once
constexpr double kContact = 1e-6;  // [m] kept between body and wall

/// Radius that the body may claim: its own, or what room it has where it overlaps a wall already.
double claimedRadius(const StaticMap& map, const Vector2d& position, double radius) {
  const auto wall = map.nearestWall(position, radius);
  return wall ? std::min(radius, wall->distance) : radius;
}

/// Pushes the body straight off the nearest wall until it touches none; false when it is wedged.
bool pushOff(const StaticMap& map, double radius, Vector2d& position) {
  for (int i = 0; i < kMaxPushes; ++i) {
    const auto wall = map.nearestWall(position, radius);
    if (!wall || wall->distance >= radius) return true;
    if (!(wall->distance > 0.0)) return false;
    position = wall->point + (position - wall->point) * ((radius + kContact) / wall->distance);
  }
  return map.discFree(position, radius);
}

/// A piece of the way that is shorter than half the body, so that it cannot reach the far side of a wall.
Vector2d slide(const StaticMap& map, const Vector2d& position, const Vector2d& piece, double radius) {
  Vector2d target = position + piece;
  if (!pushOff(map, radius, target)) return position;
  // In a corner the pushes may lead around it: then the body rather stands.
  return (target - position).norm() <= 2.0 * piece.norm() ? target : position;
}

}  // namespace

Vector2d moveAmongWalls(const StaticMap* map, const Vector2d& position, const Vector2d& displacement,
                        double radius) {
  if (map == nullptr || map->empty()) return position + displacement;
  const double length = displacement.norm();
  if (length == 0.0) return position;
  if (map->clearanceLowerBound(position) >= radius + length) return position + displacement;
  const double claimed = claimedRadius(*map, position, radius);
  const int pieces = 1 + static_cast<int>(2.0 * length / std::max(claimed, 0.01));
  Vector2d reached = position;
  for (int i = 0; i < pieces; ++i) reached = slide(*map, reached, displacement / pieces, claimed);
  return reached;
}

bool canWalkStraight(const StaticMap* map, const Vector2d& a, const Vector2d& b, double radius) {
  if (map == nullptr || map->empty()) return true;
  const double length = (b - a).norm();
  if (length == 0.0) return true;
  const Vector2d direction = (b - a) / length;
  const double shortest = 0.5 * map->geometry().resolution;
  for (double s = 0.0; s < length;) {
    const Vector2d p = a + s * direction;
    double room = map->clearanceLowerBound(p) - radius;
    if (room < shortest) {
      if (!map->discFree(p, radius)) return false;
      room = shortest;
    }
    s += room;
  }
  return map->discFree(b, radius);
}

}  // namespace kobuki_sim
