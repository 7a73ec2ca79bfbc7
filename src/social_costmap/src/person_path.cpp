// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/person_path.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace social_costmap {
namespace {

constexpr double kMaxTurnOfPiece = 0.2;  // [rad] pieces that turn more are split
constexpr int kMaxPieces = 16;           // between two predicted states

bool usable(const sarn::PredictedState& state) {
  return state.position.allFinite() && state.velocity.allFinite() && std::isfinite(state.sigma) &&
         state.position.cwiseAbs().maxCoeff() <= kMaxCoordinate &&
         state.velocity.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

PersonState interpolate(const PersonState& a, const PersonState& b, double ratio) {
  return {a.position + ratio * (b.position - a.position),
          sarn::wrapAngle(a.heading + ratio * sarn::angleDifference(a.heading, b.heading)),
          a.speed + ratio * (b.speed - a.speed), a.sigma + ratio * (b.sigma - a.sigma)};
}

// Straight pieces between a and b with their mean heading: how many keep to the tolerance.
int piecesBetween(const PersonState& a, const PersonState& b, double tolerance) {
  const double turn = std::abs(sarn::angleDifference(a.heading, b.heading));
  const Eigen::Vector2d d = b.position - a.position;
  const double mean = a.heading + 0.5 * sarn::angleDifference(a.heading, b.heading);
  const double sideways = std::abs(std::cos(mean) * d.y() - std::sin(mean) * d.x());
  const double pieces = std::max(turn / kMaxTurnOfPiece, sideways / (2.0 * tolerance));
  return static_cast<int>(std::clamp(std::ceil(pieces), 1.0, static_cast<double>(kMaxPieces)));
}

bool liesBetween(const PersonState& a, const PersonState& middle, const PersonState& b, double ratio,
                 double tolerance) {
  const PersonState expected = interpolate(a, b, ratio);
  return (expected.position - middle.position).norm() <= tolerance &&
         std::abs(sarn::angleDifference(expected.heading, middle.heading)) <= 0.5 * kMaxTurnOfPiece &&
         std::abs(expected.sigma - middle.sigma) <= tolerance;
}

}  // namespace

std::size_t usableStates(const sarn::PersonPrediction& person) {
  const auto bad = std::find_if_not(person.states.begin(), person.states.end(), usable);
  return static_cast<std::size_t>(bad - person.states.begin());
}

PersonPath::PersonPath(const sarn::PersonPrediction& person, std::size_t usable, double stamp,
                       double time_step, const SocialParams& params)
    : person_(&person),
      usable_(usable),
      stamp_(stamp),
      time_step_(time_step),
      standing_speed_(params.standing_speed),
      sigma_rate_(params.extrapolation_sigma_rate) {
  if (usable_ < 2) return;
  const double growth = person.states[usable_ - 1].sigma - person.states[usable_ - 2].sigma;
  sigma_rate_ = std::max(sigma_rate_, growth / time_step_);
}

PersonState PersonPath::stateAt(std::size_t index) const {
  const sarn::PredictedState& s = person_->states[index];
  return {s.position, std::atan2(s.velocity.y(), s.velocity.x()), s.velocity.norm(), std::max(0.0, s.sigma)};
}

PersonState PersonPath::extrapolated(std::size_t index, double duration) const {
  PersonState state = stateAt(index);
  state.position += duration * person_->states[index].velocity;
  state.sigma += std::max(0.0, duration) * sigma_rate_;
  return state;
}

PersonState PersonPath::at(double time) const {
  const double step = (time - stamp_) / time_step_;
  const double last = static_cast<double>(usable_ - 1);
  if (step <= 0.0) return extrapolated(0, time - stamp_);
  if (step >= last) return extrapolated(usable_ - 1, (step - last) * time_step_);
  const auto index = std::min(static_cast<std::size_t>(step), usable_ - 2);
  PersonState a = stateAt(index);
  PersonState b = stateAt(index + 1);
  if (a.speed < standing_speed_) a.heading = b.heading;  // who stands looks where he will go
  if (b.speed < standing_speed_) b.heading = a.heading;
  return interpolate(a, b, step - static_cast<double>(index));
}

void PersonPath::appendPieces(const PersonState& to, double tolerance,
                              std::vector<PersonState>& states) const {
  const PersonState from = states.back();
  const int pieces = piecesBetween(from, to, tolerance);
  for (int i = 1; i < pieces; ++i) states.push_back(interpolate(from, to, static_cast<double>(i) / pieces));
  states.push_back(to);
}

void PersonPath::sample(double begin, double end, double tolerance, std::vector<PersonState>& states) const {
  states.push_back(at(begin));
  double from = begin;
  const double first = std::max(0.0, std::floor((begin - stamp_) / time_step_) + 1.0);
  for (double step = first; step < static_cast<double>(usable_); step += 1.0) {
    const double knot = stamp_ + step * time_step_;
    if (knot >= end) break;
    const PersonState state = at(knot);
    const PersonState next = at(std::min(end, knot + time_step_));
    const double ratio = (knot - from) / (std::min(end, knot + time_step_) - from);
    if (liesBetween(states.back(), state, next, ratio, tolerance)) continue;
    appendPieces(state, tolerance, states);
    from = knot;
  }
  appendPieces(at(end), tolerance, states);
}

}  // namespace social_costmap
