// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/social_layers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sarn_common/cost_values.h"
#include "social_costmap/cost_painter.h"
#include "social_costmap/group_space.h"

namespace social_costmap {
namespace {

// Visits each row of each rectangle as (offset of its first cell, length).
template <class Visit>
void forEachRun(const std::vector<CellRect>& rects, const sarn::GridGeometry& grid, Visit&& visit) {
  for (const CellRect& rect : rects) {
    for (int y = rect.min_y; y < rect.max_y; ++y) {
      visit(static_cast<std::ptrdiff_t>(grid.index({rect.min_x, y})), rect.width());
    }
  }
}

}  // namespace

const char* name(PredictionStatus status) {
  switch (status) {
    case PredictionStatus::kUsed:
      return "used";
    case PredictionStatus::kDisabled:
      return "disabled";
    case PredictionStatus::kExpired:
      return "expired";
    case PredictionStatus::kFromFuture:
      return "from the future";
    case PredictionStatus::kMalformed:
      return "malformed";
  }
  return "unknown";
}

void TimeLayer::resize(const sarn::GridGeometry& grid) {
  geometry = grid;
  cells.assign(grid.size(), sarn::kFreeSpace);
  painted.clear();
}

void TimeLayer::clear() {
  forEachRun(painted, geometry, [&](std::ptrdiff_t begin, int count) {
    std::fill_n(cells.begin() + begin, count, sarn::kFreeSpace);
  });
  painted.clear();
}

void TimeLayer::copyFrom(const TimeLayer& other) {
  clear();
  forEachRun(other.painted, geometry, [&](std::ptrdiff_t begin, int count) {
    std::copy_n(other.cells.begin() + begin, count, cells.begin() + begin);
  });
  painted.assign(other.painted.begin(), other.painted.end());
}

SocialLayers::SocialLayers(const SocialParams& params) { setParams(params); }

void SocialLayers::setParams(const SocialParams& params) {
  params_ = params;
  layers_.resize(static_cast<std::size_t>(params.num_layers));
  for (TimeLayer& layer : layers_) {
    if (layer.geometry != geometry_) layer.resize(geometry_);
  }
}

void SocialLayers::resize(const sarn::GridGeometry& geometry) {
  geometry_ = geometry;
  for (TimeLayer& layer : layers_) layer.resize(geometry);
}

void SocialLayers::clear() {
  for (TimeLayer& layer : layers_) layer.clear();
}

std::vector<const std::uint8_t*> SocialLayers::layers() const {
  std::vector<const std::uint8_t*> all;
  all.reserve(layers_.size());
  for (const TimeLayer& layer : layers_) all.push_back(layer.cells.data());
  return all;
}

PredictionStatus SocialLayers::check(const sarn::PeoplePrediction& prediction, double now) const {
  if (!params_.enabled) return PredictionStatus::kDisabled;
  const bool step_is_usable = std::isfinite(prediction.time_step) && prediction.time_step > 0.0;
  if (!std::isfinite(prediction.stamp) || !std::isfinite(now) || !step_is_usable)
    return PredictionStatus::kMalformed;
  if (now - prediction.stamp > params_.people_timeout) return PredictionStatus::kExpired;
  if (prediction.stamp - now > params_.people_timeout) return PredictionStatus::kFromFuture;
  return PredictionStatus::kUsed;
}

void SocialLayers::collectPeople(const sarn::PeoplePrediction& prediction, SocialReport& report) {
  paths_.clear();
  grouped_.clear();
  for (const sarn::PersonPrediction& person : prediction.people) {
    const std::size_t usable = usableStates(person);
    if (usable == 0) {
      ++report.ignored_people;
      continue;
    }
    if (!person.group.empty()) grouped_.emplace_back(&person.group, paths_.size());
    paths_.emplace_back(person, usable, prediction.stamp, prediction.time_step, params_);
    ++report.people;
  }
  std::sort(grouped_.begin(), grouped_.end(), [](const auto& a, const auto& b) {
    const int order = a.first->compare(*b.first);
    return order != 0 ? order < 0 : a.second < b.second;
  });
}

SocialReport SocialLayers::update(const sarn::PeoplePrediction& prediction, double first_layer_time) {
  clear();
  first_layer_time_ = first_layer_time;
  SocialReport report;
  report.status = check(prediction, first_layer_time);
  if (report.status != PredictionStatus::kUsed) return report;
  collectPeople(prediction, report);
  for (int layer = 0; layer < params_.num_layers; ++layer) {
    for (const PersonPath& path : paths_) paintPerson(path, layer);
    paintGroups(layer);
  }
  return report;
}

void SocialLayers::paintPerson(const PersonPath& path, int index) {
  TimeLayer& layer = layers_[static_cast<std::size_t>(index)];
  const double begin = first_layer_time_ + index * params_.layer_duration;
  states_.clear();
  path.sample(begin, begin + params_.layer_duration, geometry_.resolution, states_);
  CellRect rect;
  for (std::size_t i = 0; i + 1 < states_.size(); ++i) {
    const PersonState& from = states_[i];
    const PersonState& to = states_[i + 1];
    rect.unite(
        paint(gaussianOf(params_, from, to, index), params_.cutoff_amplitude, geometry_, layer.cells.data()));
    const double radius = forbiddenRadius(params_, 0.5 * (from.sigma + to.sigma), index);
    rect.unite(paint(SweptDisc{from.position, to.position, radius}, geometry_, layer.cells.data()));
  }
  remember(layer, rect);
}

void SocialLayers::paintGroups(int layer) {
  for (std::size_t begin = 0; begin < grouped_.size();) {
    std::size_t end = begin + 1;
    while (end < grouped_.size() && *grouped_[end].first == *grouped_[begin].first) ++end;
    if (end - begin > 1) paintGroup(begin, end, layer);
    begin = end;
  }
}

void SocialLayers::paintGroup(std::size_t begin, std::size_t end, int index) {
  TimeLayer& layer = layers_[static_cast<std::size_t>(index)];
  const double time = first_layer_time_ + index * params_.layer_duration;
  members_from_.clear();
  members_to_.clear();
  for (std::size_t i = begin; i < end; ++i) {
    const PersonPath& path = paths_[grouped_[i].second];
    members_from_.push_back(path.at(time).position);
    members_to_.push_back(path.at(time + params_.layer_duration).position);
  }
  const double sigma = std::sqrt(params_.group_variance);
  for (const Polygon& piece : groupSpace(members_from_, members_to_, params_.group_link_distance)) {
    remember(layer, paint(piece, params_.group_amplitude, sigma, params_.cutoff_amplitude, geometry_,
                          layer.cells.data()));
  }
}

void SocialLayers::remember(TimeLayer& layer, const CellRect& rect) {
  if (!rect.empty()) layer.painted.push_back(rect);
}

sarn::PeoplePrediction transformed(const sarn::Pose2D& a_from_b, sarn::PeoplePrediction prediction) {
  const sarn::Pose2D turn{0.0, 0.0, a_from_b.theta};
  for (sarn::PersonPrediction& person : prediction.people) {
    for (sarn::PredictedState& state : person.states) {
      state.position = a_from_b * state.position;
      state.velocity = turn * state.velocity;
    }
  }
  return prediction;
}

}  // namespace social_costmap
