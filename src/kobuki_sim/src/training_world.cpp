// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/training_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kRobot = std::numeric_limits<std::size_t>::max();
const std::vector<WallEdge> kNoWalls;

void require(bool fine, const char* what, double value) {
  if (!fine)
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(value) + " is out of range");
}

TrainingParams validated(const TrainingParams& params) {
  require(std::isfinite(params.time_step) && params.time_step > 0.0, "time_step", params.time_step);
  require(params.base_time_step > 0.0 && params.base_time_step <= params.time_step, "base_time_step",
          params.base_time_step);
  require(params.time_limit > 0.0, "time_limit", params.time_limit);
  require(params.people_safety_space >= 0.0, "people_safety_space", params.people_safety_space);
  require(params.robot_safety_space >= 0.0, "robot_safety_space", params.robot_safety_space);
  require(params.radius_margin >= 0.0, "radius_margin", params.radius_margin);
  require(params.orca.time_horizon > 0.0, "time_horizon", params.orca.time_horizon);
  require(params.orca.max_neighbors >= 0, "max_neighbors", params.orca.max_neighbors);
  return params;
}

MovingDisc widened(MovingDisc disc, double extra) {
  disc.radius += extra;
  return disc;
}

}  // namespace

Vector2d preferredVelocity(const TrainingAgent& agent) {
  const Vector2d way = agent.goal - agent.disc.position;
  const double distance = way.norm();
  return distance > agent.preferred_speed ? Vector2d(way * (agent.preferred_speed / distance)) : way;
}

double closestDistance(const Vector2d& begin, const Vector2d& end) {
  const Vector2d motion = end - begin;
  const double length = motion.squaredNorm();
  const double at = length > 0.0 ? std::clamp(-begin.dot(motion) / length, 0.0, 1.0) : 0.0;
  return (begin + at * motion).norm();
}

TrainingWorld::TrainingWorld(const TrainingParams& params) : params_(validated(params)) {}

void TrainingWorld::reset(const TrainingAgent& robot, double theta, const std::vector<TrainingAgent>& people,
                          std::uint64_t seed) {
  robot_ = robot;
  theta_ = sarn::wrapAngle(theta);
  omega_ = 0.0;
  time_ = 0.0;
  people_ = people;
  decided_ = false;
  if (params_.robot_kinematics == RobotKinematics::kTurtlebot) {
    base_.emplace(params_.base, params_.base_time_step, seed);
  }
}

// --- People
// ----------------------------------------------------------------------------------------------------------

const std::vector<Vector2d>& TrainingWorld::nextPeopleVelocities() {
  if (decided_) return next_velocities_;
  next_velocities_.resize(people_.size());
  params_.people_model == TrainingPeopleModel::kOrca ? decideByOrca() : decideBySocialForce();
  decided_ = true;
  return next_velocities_;
}

void TrainingWorld::decideByOrca() {
  const double extra = params_.radius_margin + params_.people_safety_space;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    next_velocities_[i] = orcaVelocityOf(people_[i], i, params_.robot_visible, extra);
  }
}

Vector2d TrainingWorld::robotOrcaVelocity() {
  return orcaVelocityOf(robot_, kRobot, false, params_.radius_margin + params_.robot_safety_space);
}

/// ORCA among the people but `self`, and the robot if it is seen; the nearest max_neighbors, nearest first.
Vector2d TrainingWorld::orcaVelocityOf(const TrainingAgent& agent, std::size_t self, bool sees_robot,
                                       double extra_radius) {
  const double reach = params_.orca.neighbor_dist * params_.orca.neighbor_dist;
  const auto most = static_cast<std::size_t>(params_.orca.max_neighbors);
  neighbors_.clear();
  squared_distances_.clear();
  const auto consider = [&](const MovingDisc& other) {
    const double squared = (other.position - agent.disc.position).squaredNorm();
    const bool full = neighbors_.size() == most;
    if (squared >= reach || most == 0 || (full && squared >= squared_distances_.back())) return;
    if (full) {
      neighbors_.pop_back();
      squared_distances_.pop_back();
    }
    const auto place = std::upper_bound(squared_distances_.begin(), squared_distances_.end(), squared);
    neighbors_.insert(neighbors_.begin() + (place - squared_distances_.begin()),
                      {widened(other, extra_radius), 0.5});
    squared_distances_.insert(place, squared);
  };
  for (std::size_t j = 0; j < people_.size(); ++j) {
    if (j != self) consider(people_[j].disc);
  }
  if (sees_robot) consider(robot_.disc);
  return solver_.velocity(widened(agent.disc, extra_radius), preferredVelocity(agent), agent.preferred_speed,
                          params_.orca, params_.time_step, neighbors_, kNoWalls);
}

/// Lets the forces act in short steps from now on and takes the mean velocity: people then walk straight, as
/// with ORCA.
void TrainingWorld::decideBySocialForce() {
  constexpr double kLongestStep = 0.05;  // [s]
  constexpr double kMaxSpeedFactor = 1.3;
  const int steps = std::max(1, static_cast<int>(std::ceil(params_.time_step / kLongestStep - 1e-9)));
  const double dt = params_.time_step / steps;
  rollout_.clear();
  for (const TrainingAgent& person : people_)
    rollout_.push_back(widened(person.disc, params_.people_safety_space));
  if (params_.robot_visible) rollout_.push_back(widened(robot_.disc, params_.people_safety_space));
  forces_.resize(people_.size());
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < people_.size(); ++i) forces_[i] = socialForceOn(i);
    for (std::size_t i = 0; i < people_.size(); ++i) {
      Vector2d& velocity = rollout_[i].velocity;
      velocity += dt * forces_[i];
      const double limit = kMaxSpeedFactor * people_[i].preferred_speed;
      if (velocity.norm() > limit) velocity *= limit / velocity.norm();
    }
    for (MovingDisc& disc : rollout_) disc.position += dt * disc.velocity;
  }
  for (std::size_t i = 0; i < people_.size(); ++i) {
    next_velocities_[i] = (rollout_[i].position - people_[i].disc.position) / params_.time_step;
  }
}

Vector2d TrainingWorld::socialForceOn(std::size_t i) const {
  TrainingAgent now = people_[i];
  now.disc = rollout_[i];
  Vector2d force = desiredForce(preferredVelocity(now), now.disc.velocity, params_.social_force);
  const double reach = params_.social_force.neighbor_dist * params_.social_force.neighbor_dist;
  for (std::size_t j = 0; j < rollout_.size(); ++j) {
    if (j == i || (rollout_[j].position - now.disc.position).squaredNorm() >= reach) continue;
    force += interactionForce(now.disc, rollout_[j], params_.social_force) +
             contactForce(now.disc, rollout_[j], params_.social_force);
  }
  return force;
}

// --- The robot
// -------------------------------------------------------------------------------------------------------

double TrainingWorld::closestApproach(const Vector2d& robot_end, double part_begin, double part_end) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const Vector2d begin = people_[i].disc.position + part_begin * next_velocities_[i] - robot_.disc.position;
    const Vector2d end = people_[i].disc.position + part_end * next_velocities_[i] - robot_end;
    least = std::min(least, closestDistance(begin, end) - people_[i].disc.radius - robot_.disc.radius);
  }
  return least;
}

double TrainingWorld::moveInstantly(const Vector2d& action) {
  Vector2d velocity = action;
  omega_ = 0.0;
  if (params_.robot_kinematics == RobotKinematics::kUnicycle) {
    omega_ = action.y() / params_.time_step;
    theta_ = sarn::wrapAngle(theta_ + action.y());
    velocity = action.x() * Vector2d(std::cos(theta_), std::sin(theta_));
  }
  const Vector2d end = robot_.disc.position + params_.time_step * velocity;
  const double separation = closestApproach(end, 0.0, params_.time_step);
  robot_.disc.velocity = velocity;
  robot_.disc.position = end;
  return separation;
}

double TrainingWorld::moveBase(const Vector2d& action) {
  const int steps = std::max(1, static_cast<int>(std::lround(params_.time_step / params_.base_time_step)));
  const double dt = params_.time_step / steps;
  double separation = std::numeric_limits<double>::infinity();
  base_->commandVelocity(action.x(), action.y());
  for (int i = 0; i < steps; ++i) {
    const sarn::Twist2D twist = base_->drive();
    const sarn::Pose2D pose =
        sarn::advance({robot_.disc.position.x(), robot_.disc.position.y(), theta_}, twist, dt);
    base_->settle(twist, false, 0);
    separation = std::min(separation, closestApproach(pose.position(), i * dt, (i + 1) * dt));
    robot_.disc.position = pose.position();
    theta_ = pose.theta;
    omega_ = twist.omega;
    robot_.disc.velocity = twist.v * Vector2d(std::cos(theta_), std::sin(theta_));
  }
  return separation;
}

TrainingOutcome TrainingWorld::step(const Vector2d& action) {
  (void)nextPeopleVelocities();
  TrainingOutcome outcome;
  outcome.min_separation =
      params_.robot_kinematics == RobotKinematics::kTurtlebot ? moveBase(action) : moveInstantly(action);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    people_[i].disc.velocity = next_velocities_[i];
    people_[i].disc.position += params_.time_step * next_velocities_[i];
  }
  decided_ = false;
  time_ += params_.time_step;
  outcome.reached = (robot_.goal - robot_.disc.position).norm() < robot_.disc.radius;
  outcome.collision = outcome.min_separation < 0.0;
  outcome.timeout = time_ >= params_.time_limit - 1e-9;
  return outcome;
}

}  // namespace kobuki_sim
