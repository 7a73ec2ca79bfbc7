// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sarn_common/people.h"
#include "social_costmap/layer.h"
#include "social_costmap/person_path.h"
#include "social_costmap/social_params.h"

namespace social_costmap {

enum class PredictionStatus {
  kUsed,
  kDisabled,    // switched off: nobody is shown
  kExpired,     // older than people_timeout
  kFromFuture,  // newer than people_timeout: the clocks disagree
  kMalformed,   // stamp not finite or time step not positive: nobody is shown
};
[[nodiscard]] const char* name(PredictionStatus status);

/// What became of the last prediction.
struct SocialReport {
  PredictionStatus status = PredictionStatus::kUsed;
  int people = 0;          // shown (or outside the map, where they cost nothing)
  int ignored_people = 0;  // whose first state is not finite or absurdly far
};

/// A sparse layer of costs that knows which cells it holds, so that it is cleared and copied in that many
/// steps.
struct TimeLayer {
  sarn::GridGeometry geometry;
  std::vector<std::uint8_t> cells;  // row-major
  std::vector<CellRect> painted;    // all non-zero cells lie in these; they may overlap

  void resize(const sarn::GridGeometry& grid);
  void clear();
  /// The other layer has the same geometry.
  void copyFrom(const TimeLayer& other);
};

/// K time layers over one grid (Kollmitz et al. 2015; paper section IV-B c): layer i holds the people
/// predicted from first_layer_time + i * layer_duration to the end of that interval, and the spaces that
/// groups share. Costs of several people do not add up: the largest counts.
class SocialLayers {
 public:
  explicit SocialLayers(const SocialParams& params);

  void resize(const sarn::GridGeometry& geometry);
  /// The next update uses these.
  void setParams(const SocialParams& params);
  [[nodiscard]] const SocialParams& params() const { return params_; }
  /// Replaces everybody by this prediction (in the grid's frame). first_layer_time [s]: the present, or when
  /// a plan starts; the prediction's age is measured against it. Persons are told apart by what the
  /// prediction says of each, never by their place in the list: any order gives the same costs.
  SocialReport update(const sarn::PeoplePrediction& prediction, double first_layer_time);
  /// Nobody is shown.
  void clear();

  [[nodiscard]] std::vector<const std::uint8_t*> layers() const;
  [[nodiscard]] const std::vector<TimeLayer>& timeLayers() const { return layers_; }
  [[nodiscard]] const sarn::GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] double firstLayerTime() const { return first_layer_time_; }
  [[nodiscard]] double layerDuration() const { return params_.layer_duration; }

 private:
  [[nodiscard]] PredictionStatus check(const sarn::PeoplePrediction& prediction, double now) const;
  void collectPeople(const sarn::PeoplePrediction& prediction, SocialReport& report);
  void paintPerson(const PersonPath& path, int layer);
  void paintGroups(int layer);
  void paintGroup(std::size_t begin, std::size_t end, int layer);
  void remember(TimeLayer& layer, const CellRect& rect);

  SocialParams params_;
  sarn::GridGeometry geometry_;
  std::vector<TimeLayer> layers_;
  double first_layer_time_ = 0.0;
  // Scratch, kept so that updates do not allocate.
  std::vector<PersonPath> paths_;
  std::vector<std::pair<const std::string*, std::size_t>> grouped_;  // group name, index into paths_; sorted
  std::vector<PersonState> states_;
  std::vector<Eigen::Vector2d> members_from_;
  std::vector<Eigen::Vector2d> members_to_;
};

/// The same prediction seen from another frame.
[[nodiscard]] sarn::PeoplePrediction transformed(const sarn::Pose2D& a_from_b,
                                                 sarn::PeoplePrediction prediction_in_b);

}  // namespace social_costmap
