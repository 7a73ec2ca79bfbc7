// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/crowd.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kobuki_sim/people/gait.h"
#include "kobuki_sim/people/walking_space.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kTimeSlack = 1e-9;         // [s] rounding of sums of time steps
constexpr double kOutlineTolerance = 0.75;  // [cells]
constexpr std::size_t kMostWalls = 12;      // nearest edges that a person heeds
constexpr double kFarthestNudge = 0.5;      // [m] by which a place too near to a wall is corrected
constexpr double kRobotDent = 0.005;        // [m] overlap that walking into the robot can reach: a touch
constexpr double kSolidRange = 0.6;         // [m] between bodies that can meet within two decisions
constexpr double kReturnRoom = 0.15;        // [m] free around a person who is put back
constexpr double kFastestTurn = 4.0;        // [rad/s] of the torso
constexpr double kSlowestHeading = 0.15;    // [m/s] below, the torso keeps its direction
constexpr double kStandOffRange = 3.0;      // [m] people who take part in a stand-off
constexpr double kSameWay = 0.3;            // cosine from which on two people walk the same way
constexpr double kYieldChance = 0.6;        // of a person whom nobody faces
constexpr double kGroupGain = 0.4;          // [1/s] speed per distance from the middle of the group
constexpr double kGroupRoom = 0.5;          // [m] from the middle, for each fellow, that need not be closed

std::string at(const Vector2d& p) { return "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ")"; }

bool isReactive(PersonModel model) {
  return model == PersonModel::kOrca || model == PersonModel::kSocialForce;
}

double initialHeading(const PersonSpec& spec, const Vector2d& position) {
  if (spec.heading) return sarn::wrapAngle(*spec.heading);
  if (spec.waypoints.empty()) return 0.0;
  const Vector2d way = spec.waypoints.front() - position;
  return std::atan2(way.y(), way.x());
}

Vector2d limited(const Vector2d& v, double norm) {
  const double length = v.norm();
  return length > norm ? Vector2d(v * (norm / length)) : v;
}

}  // namespace

// ----------------------------------------------------------------------------------------------------
// setting up

Crowd::Crowd(const Scenario& scenario, const StaticMap* map, std::uint64_t seed, const CrowdParams& params)
    : params_(params), map_(map != nullptr && map->empty() ? nullptr : map) {
  prepareSpace(scenario);
  for (const PersonSpec& spec : scenario.people) {
    if (spec.model == PersonModel::kReplay) {
      addReplayed(spec);
    } else {
      addPerson(spec, seed);
    }
  }
  positions_.resize(people_.size());
  snapshot_.resize(people_.size());
  move(0.0, {});
}

/// Finds walls and standing people for those who walk.
void Crowd::prepareSpace(const Scenario& scenario) {
  static const StaticMap kOpenSpace;
  double reach = 0.0;
  std::vector<Vector2d> points;
  std::vector<Disc> standing;
  for (const PersonSpec& spec : scenario.people) {
    if (spec.model == PersonModel::kReplay) continue;
    points.push_back(spec.position);
    if (spec.model == PersonModel::kStanding) {
      standing.push_back({spec.position, spec.radius + params_.comfort_gap});
      continue;
    }
    points.insert(points.end(), spec.waypoints.begin(), spec.waypoints.end());
    const double max_speed = params_.max_speed_factor * spec.preferred_speed;
    reach = std::max(reach, max_speed * params_.orca.time_horizon_obst + spec.radius);
  }
  if (points.size() == standing.size() || (map_ == nullptr && standing.empty())) return;
  router_ = std::make_shared<const Router>(map_ != nullptr ? *map_ : kOpenSpace, points, std::move(standing));
  if (map_ == nullptr) return;
  const double tolerance = kOutlineTolerance * map_->geometry().resolution;
  walls_ = std::make_shared<const WallIndex>(wallEdges(wallOutlines(*map_, tolerance)), reach);
}

int Crowd::appendState(const PersonSpec& spec, const std::string& name) {
  PersonState person;
  person.id = static_cast<int>(people_.size());
  person.name = name;
  person.group = spec.group;
  person.model = spec.model;
  person.position = spec.position;
  person.heading = initialHeading(spec, spec.position);
  person.radius = spec.radius;
  person.preferred_speed = spec.preferred_speed;
  person.reacts_to_robot = spec.reacts_to_robot;
  people_.push_back(person);
  movers_.emplace_back();
  joinGroup(person.id);
  return person.id;
}

void Crowd::joinGroup(int person) {
  const std::string& group = people_[static_cast<std::size_t>(person)].group;
  if (group.empty()) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (people_[static_cast<std::size_t>(groups_[g].front())].group != group) continue;
    groups_[g].push_back(person);
    movers_[static_cast<std::size_t>(person)].group = static_cast<int>(g);
    return;
  }
  movers_[static_cast<std::size_t>(person)].group = static_cast<int>(groups_.size());
  groups_.push_back({person});
}

/// The place itself, or the nearest one where the body fits beside the wall.
Vector2d Crowd::placeable(const PersonSpec& spec, const Vector2d& p, const char* what) const {
  if (map_ == nullptr || map_->discFree(p, spec.radius)) return p;
  const Vector2d pushed = map_->pushOut(p, spec.radius);
  if ((pushed - p).norm() > kFarthestNudge || !map_->discFree(pushed, spec.radius)) {
    throw CrowdError("people: " + spec.name + ": the " + what + " " + at(p) + " is in a wall of the map");
  }
  return pushed;
}

Itinerary Crowd::findWays(const PersonSpec& spec, const Vector2d& start) const {
  std::vector<Vector2d> waypoints;
  for (const Vector2d& waypoint : spec.waypoints) waypoints.push_back(placeable(spec, waypoint, "waypoint"));
  return makeItinerary(start, waypoints, spec.on_arrival, [&](const Vector2d& a, const Vector2d& b) {
    std::vector<Vector2d> way{a, b};
    if (router_ && !router_->route(a, b, spec.radius, {}, way)) {
      throw CrowdError("people: " + spec.name + ": there is no way for a body of radius " +
                       std::to_string(spec.radius) + " m from " + at(a) + " to " + at(b));
    }
    return way;
  });
}

void Crowd::addPerson(const PersonSpec& spec, std::uint64_t seed) {
  const auto i = static_cast<std::size_t>(appendState(spec, spec.name));
  PersonState& person = people_[i];
  Mover& mover = movers_[i];
  person.position = placeable(spec, spec.position, "position");
  mover.start = person.position;
  mover.start_heading = person.heading;
  mover.start_time = spec.start_time;
  if (spec.model == PersonModel::kScripted) {
    mover.source = static_cast<int>(itineraries_.size());
    itineraries_.push_back(findWays(spec, person.position));
  } else if (isReactive(spec.model)) {
    mover.source = static_cast<int>(walkers_.size());
    walkers_.emplace_back(findWays(spec, person.position), person.position,
                          RandomStream(seed, "people/" + spec.name));
  }
}

void Crowd::addReplayed(const PersonSpec& spec) {
  const RecordingFormat format{spec.frame_rate, spec.start_frame, spec.offset};
  for (RecordedPerson& recorded : loadRecording(spec.file, format)) {
    const auto i = static_cast<std::size_t>(appendState(spec, spec.name + "_" + recorded.id));
    people_[i].position = recorded.points.front().position;
    movers_[i].start_time = spec.start_time;
    movers_[i].source = static_cast<int>(recorded_.size());
    recorded_.push_back(std::move(recorded));
  }
}

// ------------------------------------------------------------------------------------------------------
// deciding

void Crowd::step(double dt, const RobotDisc& robot) {
  if (!(dt > 0.0)) throw std::invalid_argument("Crowd::step: dt must be positive, not " + std::to_string(dt));
  RobotDisc moving_robot = robot;
  while (dt > kTimeSlack) {
    if (until_decision_ <= kTimeSlack) {
      decide(moving_robot);
      until_decision_ = params_.decision_period;
    }
    const double piece = until_decision_ - dt > kTimeSlack ? dt : std::min(dt, until_decision_);
    move(piece, moving_robot);
    moving_robot.position += piece * moving_robot.velocity;
    until_decision_ -= piece;
    dt -= piece;
  }
}

bool Crowd::reacts(std::size_t i) const {
  return isReactive(people_[i].model) && people_[i].present && time_ >= movers_[i].start_time;
}

void Crowd::takeSnapshot() {
  present_.clear();
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const PersonState& person = people_[i];
    positions_[i] = person.position;
    snapshot_[i] = {person.position, person.velocity, person.radius};
    if (person.present) present_.push_back(static_cast<int>(i));
  }
  grid_.build(positions_, present_);
}

void Crowd::decide(const RobotDisc& robot) {
  decision_time_ = params_.decision_period * static_cast<double>(decisions_++);
  takeSnapshot();
  for (std::size_t i = 0; i < people_.size(); ++i) {
    if (reacts(i)) {
      decideFor(i, robot);
    } else if (isReactive(people_[i].model) && !people_[i].present) {
      tryToReturn(i, robot);
    }
  }
}

void Crowd::decideFor(std::size_t i, const RobotDisc& robot) {
  PersonState& person = people_[i];
  Walker& walker = walkerOf(i);
  const Vector2d alone =
      walker.preferredVelocity(person, decision_time_, params_.decision_period, params_, router_.get());
  if (walker.wantsToReturn()) {
    person.present = false;
    person.velocity.setZero();
    movers_[i].command.setZero();
    return;
  }
  findNeighbors(i);
  const Vector2d preferred = keepUpWithGroup(i, alone);
  const Vector2d chosen = person.model == PersonModel::kOrca ? orcaChoice(i, preferred, robot)
                                                             : socialForceChoice(i, preferred, robot);
  if (walker.losesPatience(person, chosen, decision_time_, params_.decision_period, params_))
    resolveStandOff(i, robot);
  movers_[i].command = chosen + separation(i, robot);
}

void Crowd::findNeighbors(std::size_t i) {
  const bool orca = people_[i].model == PersonModel::kOrca;
  const double range = orca ? params_.orca.neighbor_dist : params_.social_force.neighbor_dist;
  grid_.nearest(positions_[i], static_cast<int>(i), range, params_.orca.max_neighbors, near_);
}

Vector2d Crowd::orcaChoice(std::size_t i, const Vector2d& preferred, const RobotDisc& robot) {
  const PersonState& person = people_[i];
  neighbors_.clear();
  // The gap is kept, but not forced open where it is smaller already.
  const auto avoid = [&](MovingDisc disc, double responsibility) {
    const double gap = (disc.position - person.position).norm() - disc.radius - person.radius;
    disc.radius += std::clamp(gap, 0.0, params_.comfort_gap);
    neighbors_.push_back({disc, responsibility});
  };
  if (person.reacts_to_robot) {
    const bool stands = robot.velocity.norm() < params_.standing_robot_speed;
    avoid({robot.position, robot.velocity, robot.radius}, stands ? 1.0 : 0.5);
  }
  for (const Near& near : near_) {
    const auto j = static_cast<std::size_t>(near.index);
    avoid(snapshot_[j], reacts(j) ? 0.5 : 1.0);
  }
  near_walls_.clear();
  const double max_speed = params_.max_speed_factor * person.preferred_speed;
  if (walls_) {
    walls_->nearest(person.position, max_speed * params_.orca.time_horizon_obst + person.radius, kMostWalls,
                    near_walls_);
  }
  return solver_.velocity(snapshot_[i], preferred, max_speed, params_.orca, params_.decision_period,
                          neighbors_, near_walls_);
}

Vector2d Crowd::socialForceChoice(std::size_t i, const Vector2d& preferred, const RobotDisc& robot) {
  const PersonState& person = people_[i];
  const SocialForceParams& params = params_.social_force;
  const MovingDisc& self = snapshot_[i];
  Vector2d force = desiredForce(preferred, self.velocity, params);
  const auto avoid = [&](const MovingDisc& other) {
    force += interactionForce(self, other, params) + contactForce(self, other, params);
  };
  for (const Near& near : near_) avoid(snapshot_[static_cast<std::size_t>(near.index)]);
  if (person.reacts_to_robot) avoid({robot.position, robot.velocity, robot.radius});
  if (map_ != nullptr) {
    const auto wall = map_->nearestWall(person.position, person.radius + 8.0 * params.wall_range);
    if (wall) force += wallForce(self, wall->point, params);
  }
  if (movers_[i].group >= 0 && !preferred.isZero()) {
    force += groupForce(self, preferred.normalized(), fellows_, params);
  }
  return keptSolid(i, self.velocity + params_.decision_period * force, robot);
}

/// The nearest velocity with which no bodies run into each other before the next decisions take effect.
/// Forces alone let people who meet fast overlap.
Vector2d Crowd::keptSolid(std::size_t i, const Vector2d& wanted, const RobotDisc& robot) {
  const PersonState& person = people_[i];
  neighbors_.clear();
  const auto avoid = [&](const MovingDisc& disc, double responsibility) {
    const double reach = person.radius + disc.radius + kSolidRange;
    if ((disc.position - person.position).squaredNorm() < reach * reach) {
      neighbors_.push_back({disc, responsibility});
    }
  };
  if (person.reacts_to_robot) avoid({robot.position, robot.velocity, robot.radius}, 1.0);
  for (const Near& near : near_) {
    const auto j = static_cast<std::size_t>(near.index);
    avoid(snapshot_[j], reacts(j) ? 0.5 : 1.0);
  }
  OrcaParams contact = params_.orca;
  contact.time_horizon = 2.0 * params_.decision_period;
  near_walls_.clear();
  return solver_.velocity(snapshot_[i], wanted, params_.max_speed_factor * person.preferred_speed, contact,
                          params_.decision_period, neighbors_, near_walls_);
}

/// Who is ahead of the group slows down, who is behind hurries, who is far aside comes nearer.
Vector2d Crowd::keepUpWithGroup(std::size_t i, const Vector2d& preferred) {
  fellows_.clear();
  if (movers_[i].group < 0) return preferred;
  for (const int member : groups_[static_cast<std::size_t>(movers_[i].group)]) {
    const auto j = static_cast<std::size_t>(member);
    if (j != i && reacts(j)) fellows_.push_back(positions_[j]);
  }
  const double speed = preferred.norm();
  const bool cohesion_by_force = people_[i].model == PersonModel::kSocialForce;
  if (fellows_.empty() || speed < 1e-6 || cohesion_by_force) return preferred;
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& fellow : fellows_) middle += fellow;
  middle /= static_cast<double>(fellows_.size());
  const Vector2d direction = preferred / speed;
  const Vector2d offset = middle - positions_[i];
  const double ahead = offset.dot(direction);
  const Vector2d aside = offset - ahead * direction;
  const double room = kGroupRoom * static_cast<double>(fellows_.size());
  const double excess = std::max(0.0, aside.norm() - room);
  const double pace = std::clamp(speed + kGroupGain * ahead, 0.2 * speed, params_.max_speed_factor * speed);
  const Vector2d together =
      excess > 0.0 ? Vector2d(kGroupGain * excess * aside.normalized()) : Vector2d(Vector2d::Zero());
  return limited(pace * direction + together, params_.max_speed_factor * people_[i].preferred_speed);
}

/// Velocity that takes apart who overlaps; both do half, but all of it beside somebody who does not react.
Vector2d Crowd::separation(std::size_t i, const RobotDisc& robot) const {
  Vector2d sum = Vector2d::Zero();
  const auto push = [&](const Vector2d& from, double radius, double share, double side) {
    const Vector2d apart = positions_[i] - from;
    const double distance = apart.norm();
    const double overlap = people_[i].radius + radius - distance;
    if (overlap <= 0.0) return;
    const Vector2d direction =
        distance > 1e-6 ? Vector2d(apart / distance) : Vector2d(side * Vector2d::UnitX());
    sum += share * overlap / params_.decision_period * direction;
  };
  for (const Near& near : near_) {
    const auto j = static_cast<std::size_t>(near.index);
    push(positions_[j], people_[j].radius, reacts(j) ? 0.5 : 1.0, i < j ? -1.0 : 1.0);
  }
  if (people_[i].reacts_to_robot) push(robot.position, robot.radius, 1.0, 1.0);
  return limited(sum, params_.separation_speed);
}

/// Of two streams that face each other, the one with the person who comes first in the scenario goes on, and
/// the other makes room; so a whole stream yields, not single people of both. Where nobody faces the person,
/// chance decides.
void Crowd::resolveStandOff(std::size_t i, const RobotDisc& robot) {
  Walker& walker = walkerOf(i);
  int first_of_ours = static_cast<int>(i);
  int first_of_theirs = -1;
  int nearest_of_theirs = -1;
  for (const Near& near : near_) {
    const auto j = static_cast<std::size_t>(near.index);
    if (near.squared_distance > kStandOffRange * kStandOffRange || !reacts(j)) continue;
    const double agreement = walkerOf(j).direction().dot(walker.direction());
    if (agreement > kSameWay) first_of_ours = std::min(first_of_ours, near.index);
    if (agreement >= -kSameWay) continue;
    if (nearest_of_theirs < 0) nearest_of_theirs = near.index;
    first_of_theirs = first_of_theirs < 0 ? near.index : std::min(first_of_theirs, near.index);
  }
  if (first_of_theirs < 0) {
    walkAround(i, robot);
  } else if (first_of_ours < first_of_theirs) {
    walker.tryOn(params_);
  } else {
    makeRoom(i, static_cast<std::size_t>(nearest_of_theirs));
  }
}

/// Past somebody who stands in the way, or a little back and aside where chance decides so.
void Crowd::walkAround(std::size_t i, const RobotDisc& robot) {
  Walker& walker = walkerOf(i);
  walker.tryOn(params_);
  if (router_ == nullptr || walker.draw() < kYieldChance) {
    walker.stepAside(Vector2d::Zero(), decision_time_, params_);
    return;
  }
  std::vector<Disc> standing;
  for (const Near& near : near_) {
    const MovingDisc& other = snapshot_[static_cast<std::size_t>(near.index)];
    if (other.velocity.norm() > params_.standing_robot_speed) continue;
    standing.push_back({other.position, other.radius + params_.comfort_gap});
  }
  if (people_[i].reacts_to_robot && robot.velocity.norm() < params_.standing_robot_speed) {
    standing.push_back({robot.position, robot.radius + params_.comfort_gap});
  }
  walker.takeDetour(people_[i], standing, decision_time_, *router_);
}

/// The person and everyone near who walks the same way go back, each to the side of the others' way on which
/// they are already.
void Crowd::makeRoom(std::size_t i, std::size_t oncoming) {
  const Vector2d our_way = walkerOf(i).direction();
  const Vector2d their_way = walkerOf(oncoming).direction();
  const Vector2d across(-their_way.y(), their_way.x());
  const auto yield = [&](std::size_t j) {
    const double side = across.dot(positions_[j] - positions_[oncoming]) >= 0.0 ? 1.0 : -1.0;
    walkerOf(j).stepAside((0.5 * their_way + side * across).normalized(), decision_time_, params_);
  };
  yield(i);
  for (const Near& near : near_) {
    const auto j = static_cast<std::size_t>(near.index);
    if (near.squared_distance > kStandOffRange * kStandOffRange || !reacts(j)) continue;
    if (walkerOf(j).direction().dot(our_way) > kSameWay) yield(j);
  }
}

void Crowd::tryToReturn(std::size_t i, const RobotDisc& robot) {
  const Vector2d& start = movers_[i].start;
  PersonState& person = people_[i];
  const auto is_free = [&](const Vector2d& p, double radius) {
    return (p - start).norm() > person.radius + radius + kReturnRoom;
  };
  if (!is_free(robot.position, robot.radius)) return;
  for (const PersonState& other : people_) {
    if (other.present && !is_free(other.position, other.radius)) return;
  }
  person.position = positions_[i] = start;
  person.velocity.setZero();
  person.heading = movers_[i].start_heading;
  person.present = true;
  walkerOf(i).restart();
}

// --------------------------------------------------------------------------------------------------------
// moving

void Crowd::move(double dt, const RobotDisc& robot) {
  time_ += dt;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    switch (people_[i].model) {
      case PersonModel::kOrca:
      case PersonModel::kSocialForce:
        if (reacts(i) && dt > 0.0) walk(i, dt, robot);
        break;
      case PersonModel::kScripted:
        followTimetable(i, dt);
        break;
      case PersonModel::kReplay:
        followRecording(i, dt);
        break;
      case PersonModel::kStanding:
        break;
    }
  }
}

void Crowd::walk(std::size_t i, double dt, const RobotDisc& robot) {
  PersonState& person = people_[i];
  const Vector2d before = person.position;
  Vector2d after = moveAmongWalls(map_, before, dt * movers_[i].command, person.radius);
  const double contact = person.radius + robot.radius - kRobotDent;
  const Vector2d from_robot = after - robot.position;
  const double distance = from_robot.norm();
  const double allowed = std::min(contact, (before - robot.position).norm());
  if (distance < allowed && distance > 0.0) {  // nobody walks through the robot
    after = moveAmongWalls(map_, before, robot.position + from_robot * (allowed / distance) - before,
                           person.radius);
  }
  person.position = after;
  person.velocity = (after - before) / dt;
  turnAndStride(person, (after - before).norm(), dt);
}

void Crowd::followTimetable(std::size_t i, double dt) {
  const Mover& mover = movers_[i];
  PersonState& person = people_[i];
  const Itinerary& itinerary = itineraries_[static_cast<std::size_t>(mover.source)];
  const TimetablePoint point =
      timetablePoint(itinerary, mover.start, person.preferred_speed, time_ - mover.start_time);
  person.position = point.position;
  person.velocity = point.velocity;
  turnAndStride(person, dt * point.velocity.norm(), dt);
}

void Crowd::followRecording(std::size_t i, double dt) {
  Mover& mover = movers_[i];
  PersonState& person = people_[i];
  const RecordedPerson& recorded = recorded_[static_cast<std::size_t>(mover.source)];
  const auto state = recordedState(recorded, time_ - mover.start_time, mover.recording_hint);
  const bool appears = state && !person.present;
  person.present = state.has_value();
  person.velocity = state ? state->velocity : Vector2d(Vector2d::Zero());
  if (!state) return;
  person.position = state->position;
  if ((appears || dt == 0.0) && person.velocity.norm() > kSlowestHeading) {
    person.heading = std::atan2(person.velocity.y(), person.velocity.x());
  }
  turnAndStride(person, dt * person.velocity.norm(), dt);
}

/// Turns the torso towards the motion, not faster than people turn, and moves the legs on.
void Crowd::turnAndStride(PersonState& person, double distance, double dt) const {
  if (!(dt > 0.0)) return;
  const double speed = distance / dt;
  person.walking_phase = advancePhase(person.walking_phase, distance, speed);
  if (speed < kSlowestHeading) return;
  const double target = std::atan2(person.velocity.y(), person.velocity.x());
  const double turn = sarn::angleDifference(person.heading, target);
  person.heading = sarn::wrapAngle(person.heading + std::clamp(turn, -kFastestTurn * dt, kFastestTurn * dt));
}

}  // namespace kobuki_sim
