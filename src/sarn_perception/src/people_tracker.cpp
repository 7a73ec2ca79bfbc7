// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/people_tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "sarn_perception/assignment.h"
#include "sarn_perception/checked_params.h"
#include "sarn_perception/existence.h"
#include "sarn_perception/leg_association.h"

namespace sarn_perception {
namespace {

constexpr double kMaxExistence = 0.99;
constexpr double kLongestLook = 0.2;  // [s] evidence of one look, however long the last one is ago
constexpr double kSeen = 0.2;         // [s] since the last detection, a person counts as seen
constexpr double kOntoShare = 0.3;    // of a look that saw something else where a person should be
constexpr double kNobody = 1e3;       // price in an assignment

constexpr double kAnywhere = 0.5;  // [m] where somebody is before their legs are taken in

/// Likelihood ratio of a detection that is only `confidence` sure to be one.
double weighted(double ratio, double confidence) { return 1.0 + (ratio - 1.0) * confidence; }

/// Likelihood ratio of one or two legs.
double ratioOf(const std::vector<Leg>& legs, const TrackerParams& params) {
  return weighted(legs.size() == 2 ? params.pair_ratio : params.leg_ratio,
                  0.5 * (legs.front().confidence + legs.back().confidence));
}

}  // namespace

double PersonTrack::reliability() const {
  constexpr double kNear = 0.5;  // [m]
  const double apart = kNear / filter.positionSigma();
  return existence * -std::expm1(-0.5 * apart * apart);
}

PeopleTracker::PeopleTracker(const TrackerParams& params) : params_(checkedParams(params)) {}

void PeopleTracker::clear() {
  tracks_.clear();
  started_ = false;
  looked_ = {};
}

void PeopleTracker::advance(double stamp) {
  if (!started_) now_ = stamp;
  started_ = true;
  const double dt = stamp - now_;
  if (!(dt > 0.0)) return;
  now_ = stamp;
  for (PersonTrack& track : tracks_) {
    predict(track, dt);
    track.existence *= std::exp(-dt / params_.survival_time);
    if (blocked_ && blocked_(track.filter.position())) track.filter.halt();
  }
  finish();
}

void PeopleTracker::predict(PersonTrack& track, double dt) const {
  if (now_ - track.last_seen < kSeen) {
    track.filter.predict(
        dt, {params_.steady_density, params_.changing_density, params_.steady_time, params_.changing_time});
  } else if (track.standing) {
    track.filter.rest(dt, params_.stay_wander);
  } else {
    const double walking = std::min(1.0, track.filter.velocity().norm() / params_.walking_speed);
    track.filter.predict(
        dt, params_.standing_density + walking * (params_.walking_density - params_.standing_density));
  }
}

bool PeopleTracker::begin(Detector detector, double stamp) {
  const auto i = static_cast<std::size_t>(detector);
  if (started_ && stamp < now_ - params_.max_delay) return false;
  if (looked_[i] && !(stamp > last_look_[i])) return false;
  advance(stamp);
  return true;
}

PeopleTracker::Look PeopleTracker::look(Detector detector, const RangeProfile& profile,
                                        const sarn::Pose2D& frame_from_sensor, double stamp) {
  const auto i = static_cast<std::size_t>(detector);
  const double dt = looked_[i] ? std::min(stamp - last_look_[i], kLongestLook) : kLongestLook;
  looked_[i] = true;
  last_look_[i] = stamp;
  return {profile, sarn::inverse(frame_from_sensor), now_ - stamp, dt};
}

void PeopleTracker::seen(PersonTrack& track, double ratio, double age, Detector detector) const {
  track.existence = std::min(kMaxExistence, existenceAfterDetection(track.existence, ratio));
  track.last_seen = std::max(track.last_seen, now_ - age);
  ++track.detections;
  ++track.seen_by[static_cast<std::size_t>(detector)];
  judgeStanding(track);
}

void PeopleTracker::judgeStanding(PersonTrack& track) const {
  const Eigen::Vector2d place = track.filter.position();
  if ((place - track.halt).norm() > params_.stay_distance) {
    track.halt = place;
    track.halted = track.last_seen;
  }
  track.standing = track.last_seen - track.halted >= params_.stay_time &&
                   track.filter.velocity().norm() <= params_.stay_speed;
}

void PeopleTracker::miss(PersonTrack& track, const Look& look) const {
  const Eigen::Vector2d place = look.sensor_from_frame * track.filter.positionBefore(look.age);
  const Sight sight = lookAt(look.profile, place, params_.person_radius);
  const double in_view = std::min(1.0, sight.through + kOntoShare * sight.onto);
  const double probability =
      in_view * detectionWithin(look.dt, params_.detection_probability, params_.detection_time);
  track.existence = existenceAfterMiss(track.existence, probability);
}

void PeopleTracker::giveLegs(const std::vector<Leg>& legs, bool confirmed,
                             std::vector<std::size_t>& available, std::vector<bool>& is_seen, double age) {
  std::vector<std::size_t> owners;
  std::vector<const WalkingFilter*> people;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].confirmed != confirmed) continue;
    owners.push_back(i);
    people.push_back(&tracks_[i].filter);
  }
  LegShares shares = shareLegs(people, legs, available, age, params_);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (shares.of_person[i].empty()) continue;
    const std::vector<Leg> own = measured(legs, shares.of_person[i]);
    tracks_[owners[i]].filter.updateLegs(own, age);
    seen(tracks_[owners[i]], ratioOf(own, params_), age, Detector::kLegs);
    is_seen[owners[i]] = true;
  }
  available = std::move(shares.unclaimed);
}

bool PeopleTracker::addLegs(const std::vector<Leg>& legs, const RangeProfile& profile,
                            const sarn::Pose2D& frame_from_sensor, double stamp) {
  if (!begin(Detector::kLegs, stamp)) return false;
  const Look now = look(Detector::kLegs, profile, frame_from_sensor, stamp);
  std::vector<std::size_t> available(legs.size());
  for (std::size_t i = 0; i < legs.size(); ++i) available[i] = i;
  std::vector<bool> seen(tracks_.size(), false);
  giveLegs(legs, true, available, seen, now.age);
  giveLegs(legs, false, available, seen, now.age);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) miss(tracks_[i], now);
  }
  for (const auto& own : pairLegs(legs, available, params_.max_leg_separation)) {
    const std::vector<Leg> both = measured(legs, own);
    WalkingFilter filter = newcomer(0.5 * (both.front().position + both.back().position), kAnywhere);
    filter.updateLegs(both, 0.0);
    found(filter, ratioOf(both, params_), now.age, Detector::kLegs);
  }
  finish();
  return true;
}

void PeopleTracker::giveBodies(const std::vector<Body>& bodies, bool confirmed,
                               std::vector<std::size_t>& available, std::vector<bool>& is_seen, double age) {
  std::vector<std::size_t> owners;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].confirmed == confirmed) owners.push_back(i);
  }
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(owners.size()),
                                                   static_cast<Eigen::Index>(available.size()),
                                                   std::numeric_limits<double>::infinity());
  const auto sigma = [&](const Body& body) { return std::hypot(params_.body_sigma, body.sigma); };
  for (std::size_t i = 0; i < owners.size(); ++i) {
    for (std::size_t j = 0; j < available.size(); ++j) {
      const Body& body = bodies[available[j]];
      // A track that only ever saw one leg stands beside its person.
      const double slack = std::hypot(sigma(body), 0.5 * params_.gait_sigma);
      const Fit fit = detectionFit(tracks_[owners[i]].filter, body.position, slack, age, params_);
      if (!fit.gated) cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = fit.cost;
    }
  }
  const std::vector<int> columns = assign(cost, kNobody);
  std::vector<bool> taken(bodies.size(), false);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (columns[i] < 0) continue;
    const std::size_t index = available[static_cast<std::size_t>(columns[i])];
    const Body& body = bodies[index];
    tracks_[owners[i]].filter.update(body.position, sigma(body), age);
    seen(tracks_[owners[i]], weighted(params_.body_ratio, body.confidence), age, Detector::kBodies);
    taken[index] = true;
    is_seen[owners[i]] = true;
  }
  available.erase(
      std::remove_if(available.begin(), available.end(), [&](std::size_t body) { return taken[body]; }),
      available.end());
}

bool PeopleTracker::addBodies(const std::vector<Body>& bodies, const RangeProfile& profile,
                              const sarn::Pose2D& frame_from_sensor, double stamp) {
  if (!begin(Detector::kBodies, stamp)) return false;
  const Look now = look(Detector::kBodies, profile, frame_from_sensor, stamp);
  std::vector<std::size_t> available(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) available[i] = i;
  std::vector<bool> seen(tracks_.size(), false);
  giveBodies(bodies, true, available, seen, now.age);
  giveBodies(bodies, false, available, seen, now.age);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) miss(tracks_[i], now);
  }
  for (const std::size_t i : available) {
    found(newcomer(bodies[i].position, params_.body_sigma),
          weighted(params_.body_ratio, bodies[i].confidence), now.age, Detector::kBodies);
  }
  finish();
  return true;
}

bool PeopleTracker::nearSomebody(const Eigen::Vector2d& position, double age) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const PersonTrack& track) {
    return (track.filter.positionBefore(age) - position).norm() < params_.min_person_distance;
  });
}

WalkingFilter PeopleTracker::newcomer(const Eigen::Vector2d& position, double sigma) const {
  return {position,
          sigma,
          params_.initial_speed_sigma,
          {params_.stance_sigma, params_.swing_time, params_.settle_time, params_.max_speed}};
}

std::vector<Leg> PeopleTracker::measured(const std::vector<Leg>& legs,
                                         const std::vector<std::size_t>& own) const {
  std::vector<Leg> result;
  for (const std::size_t i : own) {
    result.push_back(legs[i]);
    result.back().sigma = std::hypot(params_.leg_sigma, legs[i].sigma);
  }
  return result;
}

void PeopleTracker::found(const WalkingFilter& filter, double ratio, double age, Detector detector) {
  if (nearSomebody(filter.position(), age)) return;
  PersonTrack track{next_id_++, filter};
  track.existence = existenceAfterDetection(params_.birth_existence, ratio);
  track.first_seen = track.last_seen = track.halted = now_ - age;
  track.halt = filter.position();
  track.detections = 1;
  track.seen_by[static_cast<std::size_t>(detector)] = 1;
  tracks_.push_back(track);
}

void PeopleTracker::mergeDoubles() {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    for (std::size_t j = i + 1; j < tracks_.size(); ++j) {
      PersonTrack& a = tracks_[i];
      PersonTrack& b = tracks_[j];
      if ((a.filter.position() - b.filter.position()).norm() >= params_.min_person_distance) continue;
      // The one that was seen less goes; of equals the younger.
      PersonTrack& loser = b.last_seen > a.last_seen && a.detections < b.detections ? a : b;
      loser.existence = 0.0;
    }
  }
}

void PeopleTracker::finish() {
  for (PersonTrack& track : tracks_) {
    // Seen twice at least: one scan alone convinces nobody.
    if (track.existence >= params_.confirm_existence && track.detections > 1) track.confirmed = true;
  }
  mergeDoubles();
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [&](const PersonTrack& track) {
                                 return track.existence < params_.forget_existence ||
                                        track.filter.positionSigma() > params_.max_sigma ||
                                        now_ - track.last_seen >
                                            (track.standing ? params_.stay_unseen : params_.max_unseen);
                               }),
                tracks_.end());
}

std::vector<PersonTrack> PeopleTracker::people() const {
  std::vector<PersonTrack> people;
  std::copy_if(tracks_.begin(), tracks_.end(), std::back_inserter(people), [&](const PersonTrack& track) {
    return track.confirmed && track.existence >= params_.report_existence &&
           track.filter.positionSigma() <= params_.report_sigma;
  });
  return people;
}

}  // namespace sarn_perception
