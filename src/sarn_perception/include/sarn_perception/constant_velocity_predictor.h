// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sarn_common/people.h"
#include "sarn_perception/prediction_params.h"
#include "sarn_perception/wall_field.h"

namespace sarn_perception {

/// Standard deviation [m] on any axis of a person's position `t` [s] after its measurement, t >= 0. With
/// standard deviations sigma_p, sigma_v of the measured position and velocity and white acceleration of power
/// q: sigma^2 = sigma_p^2 + sigma_v^2 t^2 + q t^3 / 3 (Bar-Shalom, Li and Kirubarajan 2001, eq. 6.2.2-4, the
/// continuous white-noise acceleration model). A standing person has its own sigma_v and no acceleration.
[[nodiscard]] double predictionSigma(const PredictionParams& params, bool walking, double t);

/// Keeps everybody's last measurement and extends it at constant velocity, up to walls.
class ConstantVelocityPredictor {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit ConstantVelocityPredictor(const PredictionParams& params);

  /// Walls that people do not walk through; without a map there are none.
  void setMap(const sarn::OccupancyMap& map) { walls_ = WallField(map); }

  /// Takes what was measured at `stamp` [s], in the planning frame. Measurements without a name replace the
  /// earlier ones without a name. Returns one line for each thing it refused: a name given twice, a value
  /// that is not finite, a measurement older than one it has.
  std::vector<std::string> observe(const std::vector<sarn::Person>& people, double stamp);

  /// Everybody not older than the timeout, from `now` [s] on; forgets the others.
  [[nodiscard]] sarn::PeoplePrediction predict(double now);

  /// Forgets everybody: the clock jumped.
  void clear() { tracks_.clear(); }
  [[nodiscard]] std::size_t size() const { return tracks_.size(); }

 private:
  struct Track {
    sarn::Person person;
    double stamp = 0.0;  // [s]
    bool named = true;
  };

  [[nodiscard]] sarn::PersonPrediction extend(const Track& track, double now) const;

  PredictionParams params_;
  WallField walls_;
  std::map<std::string, Track> tracks_;  // by name
};

}  // namespace sarn_perception
