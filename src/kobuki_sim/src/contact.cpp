// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/contact.h"

namespace kobuki_sim {
namespace {

Contact makeContact(double time, const RobotDisc& robot, const Eigen::Vector2d& towards_other,
                    double standing_time) {
  Contact contact;
  contact.time = time;
  contact.point = robot.position + robot.radius * towards_other;
  contact.robot_closing_speed = robot.velocity.dot(towards_other);
  contact.robot_speed = robot.velocity.norm();
  contact.standing_time = standing_time;
  return contact;
}

/// Unit vector from a to b; x axis when they coincide.
Eigen::Vector2d direction(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double length = d.norm();
  return length > 0.0 ? Eigen::Vector2d(d / length) : Eigen::Vector2d::UnitX();
}

}  // namespace

void ContactMonitor::reset() {
  standing_time_ = 0.0;
  last_wall_touch_ = -HUGE_VAL;
  last_person_touch_.clear();
}

bool ContactMonitor::beginsTouch(double& last_touch, double time) const {
  const bool begins = time - last_touch > params_.release_time;
  last_touch = time;
  return begins;
}

void ContactMonitor::updateWall(double time, const RobotDisc& robot, const StaticMap& map,
                                std::vector<Contact>& events) {
  const auto wall = map.nearestWall(robot.position, robot.radius + params_.tolerance);
  if (!wall || !beginsTouch(last_wall_touch_, time)) return;
  Contact contact = makeContact(time, robot, direction(robot.position, wall->point), standing_time_);
  contact.other = "wall";
  events.push_back(std::move(contact));
}

void ContactMonitor::updatePerson(double time, const RobotDisc& robot, const PersonState& person,
                                  std::vector<Contact>& events) {
  if (!person.present) return;
  const double reach = robot.radius + person.radius + params_.tolerance;
  if ((person.position - robot.position).squaredNorm() > reach * reach) return;
  if (!beginsTouch(last_person_touch_[static_cast<std::size_t>(person.id)], time)) return;
  const Eigen::Vector2d towards_person = direction(robot.position, person.position);
  Contact contact = makeContact(time, robot, towards_person, standing_time_);
  contact.other = person.name;
  contact.person = person.id;
  contact.other_closing_speed = -person.velocity.dot(towards_person);
  events.push_back(std::move(contact));
}

void ContactMonitor::update(double time, double dt, const RobotDisc& robot,
                            const std::vector<PersonState>& people, const StaticMap& map,
                            std::vector<Contact>& events) {
  const bool stands = robot.velocity.norm() <= params_.standing_speed;
  standing_time_ = stands ? standing_time_ + dt : 0.0;
  last_person_touch_.resize(people.size(), -HUGE_VAL);
  updateWall(time, robot, map, events);
  for (const PersonState& person : people) updatePerson(time, robot, person, events);
}

}  // namespace kobuki_sim
