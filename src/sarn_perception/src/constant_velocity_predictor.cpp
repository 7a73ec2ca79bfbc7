// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/constant_velocity_predictor.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "sarn_common/parameters.h"

namespace sarn_perception {
namespace {

const PredictionParams& checked(const PredictionParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
  return params;
}

}  // namespace

double predictionSigma(const PredictionParams& params, bool walking, double t) {
  const double sigma_v = walking ? params.velocity_sigma : params.standing_sigma;
  const double q = walking ? params.acceleration_density : 0.0;
  const double variance =
      params.position_sigma * params.position_sigma + sigma_v * sigma_v * t * t + q * t * t * t / 3.0;
  return std::min(params.max_sigma, std::sqrt(variance));
}

ConstantVelocityPredictor::ConstantVelocityPredictor(const PredictionParams& params)
    : params_(checked(params)) {}

std::vector<std::string> ConstantVelocityPredictor::observe(const std::vector<sarn::Person>& people,
                                                            double stamp) {
  std::vector<std::string> refused;
  std::set<std::string> seen;
  int nameless = 0;
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    track = track->second.named ? std::next(track) : tracks_.erase(track);
  }
  for (const sarn::Person& person : people) {
    if (!person.position.allFinite() || !person.velocity.allFinite()) {
      refused.push_back("'" + person.name + "' has a position or velocity that is not finite");
      continue;
    }
    const bool named = !person.name.empty();
    const std::string name = named ? person.name : "person_without_name_" + std::to_string(nameless++);
    if (!seen.insert(name).second) {
      refused.push_back("'" + name + "' is there twice; names must be unique, the first one is taken");
      continue;
    }
    const auto known = tracks_.find(name);
    if (known != tracks_.end() && known->second.stamp > stamp) {
      refused.push_back("'" + name + "' was measured later already; the older measurement is left out");
      continue;
    }
    Track track{person, stamp, named};
    track.person.name = name;
    tracks_[name] = track;
  }
  return refused;
}

sarn::PersonPrediction ConstantVelocityPredictor::extend(const Track& track, double now) const {
  const bool walking = track.person.velocity.norm() >= params_.standing_speed;
  const double age = now - track.stamp;
  Walker walker{track.person.position,
                walking ? track.person.velocity : Eigen::Vector2d(Eigen::Vector2d::Zero())};
  const auto advance = [&](double dt) {
    if (params_.walls == "ignore" || dt < 0.0) {
      walker.position += dt * walker.velocity;
    } else {
      walk(walls_, params_.wall_clearance, params_.walls == "slide", dt, walker);
    }
  };
  sarn::PersonPrediction prediction{track.person.name, track.person.group, {}};
  advance(age);
  for (int i = 0; i < params_.num_predictions; ++i) {
    if (i > 0) advance(params_.time_step);
    const double t = std::max(0.0, age + i * params_.time_step);
    prediction.states.push_back({walker.position, walker.velocity, predictionSigma(params_, walking, t)});
  }
  return prediction;
}

sarn::PeoplePrediction ConstantVelocityPredictor::predict(double now) {
  sarn::PeoplePrediction prediction{now, params_.time_step, {}};
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    if (now - track->second.stamp > params_.timeout) {
      track = tracks_.erase(track);
      continue;
    }
    prediction.people.push_back(extend(track->second, now));
    ++track;
  }
  return prediction;
}

}  // namespace sarn_perception
