// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/robot_motion.h"

#include <algorithm>
#include <cmath>

#include "kobuki_sim/kobuki_sensors.h"

namespace kobuki_sim {
namespace {

constexpr double kLongestMove = 0.02;  // [m] at once, so that nothing is jumped over

/// Pushes the robot's centre out of a person, but no farther from it than it was at `before`.
void stayOutOfPerson(const PersonState& person, double radius, const Eigen::Vector2d& before,
                     Eigen::Vector2d& p) {
  if (!person.present) return;
  const double reach = radius + person.radius;
  const Eigen::Vector2d d = p - person.position;
  if (d.squaredNorm() >= reach * reach) return;
  const double allowed = std::min(reach, (before - person.position).norm());
  const double distance = d.norm();
  if (distance >= allowed) return;
  p = distance > 1e-12 ? Eigen::Vector2d(person.position + d * (allowed / distance)) : before;
}

/// True when the move brings the robot deeper into somebody.
bool pressesIntoPerson(const std::vector<PersonState>& people, double radius, const Eigen::Vector2d& before,
                       const Eigen::Vector2d& after) {
  constexpr double kRounding = 1e-9;  // [m]
  return std::any_of(people.begin(), people.end(), [&](const PersonState& person) {
    const double allowed = std::min(radius + person.radius, (before - person.position).norm());
    return person.present && (after - person.position).norm() < allowed - kRounding;
  });
}

/// One short move of the centre; where it cannot go without entering something, it stays.
Eigen::Vector2d slide(const Eigen::Vector2d& before, const Eigen::Vector2d& move, double radius,
                      const StaticMap& map, const std::vector<PersonState>& people) {
  Eigen::Vector2d p = map.pushOut(before + move, radius);
  const Eigen::Vector2d among_walls = p;
  for (const PersonState& person : people) stayOutOfPerson(person, radius, before, p);
  if (p == among_walls) return map.discFree(p, radius) ? p : before;
  p = map.pushOut(p, radius);
  return map.discFree(p, radius) && !pressesIntoPerson(people, radius, before, p) ? p : before;
}

}  // namespace

RobotStep moveRobot(const sarn::Pose2D& pose, const sarn::Twist2D& wanted, double dt, double radius,
                    const StaticMap& map, const std::vector<PersonState>& people) {
  const int moves = std::max(1, static_cast<int>(std::ceil(std::abs(wanted.v) * dt / kLongestMove)));
  RobotStep step;
  step.pose = pose;
  double forward = 0.0;  // [m]
  for (int i = 0; i < moves; ++i) {
    const sarn::Pose2D& before = step.pose;
    const sarn::Pose2D free = sarn::advance(before, wanted, dt / moves);
    const Eigen::Vector2d free_move = free.position() - before.position();
    if (free_move.squaredNorm() == 0.0) {
      step.pose.theta = free.theta;
      continue;
    }
    const Eigen::Vector2d reached = slide(before.position(), free_move, radius, map, people);
    const Eigen::Vector2d moved = reached - before.position();
    if (reached == free.position()) {
      forward += wanted.v * dt / moves;
    } else {
      step.blocked = true;
      // The share of the wanted motion that came true, along its direction.
      forward += wanted.v * dt / moves * std::min(1.0, moved.dot(free_move) / free_move.squaredNorm());
    }
    step.pose = {reached.x(), reached.y(), free.theta};
  }
  step.velocity = (step.pose.position() - pose.position()) / dt;
  step.twist = {forward / dt, wanted.omega};
  return step;
}

std::uint8_t pressedBumpers(const sarn::Pose2D& pose, double radius, double tolerance, const StaticMap& map,
                            const std::vector<PersonState>& people) {
  unsigned bits = 0;
  const Eigen::Vector2d center = pose.position();
  const auto press = [&](const Eigen::Vector2d& point) {
    const Eigen::Vector2d d = point - center;
    if (const auto bit = bumperBit(std::atan2(d.y(), d.x()) - pose.theta)) bits |= *bit;
  };
  if (map.clearanceLowerBound(center) <= radius + tolerance) {
    map.forEachWallWithin(
        center, radius + tolerance,
        [&](const sarn::CellIndex&, const Eigen::Vector2d& point, double) { press(point); });
  }
  for (const PersonState& person : people) {
    const double reach = radius + person.radius + tolerance;
    if (person.present && (person.position - center).squaredNorm() <= reach * reach) press(person.position);
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace kobuki_sim
